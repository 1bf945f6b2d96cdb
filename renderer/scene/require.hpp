#pragma once
// Checks of input. A failed check throws BadInput "found ..., expected ...".

#include "base/errors.hpp"
#include "base/fields.hpp"

namespace renderer {

using base::at_place;

/// Throws BadInput unless `holds` is true. The caller adds the position to the message.
template <class Found>
void require(bool holds, const Found& found, std::string_view expected) {
  if (!holds) throw base::BadInput(fmt::format("found {}, expected {}", found, expected));
}

/// Throws BadInput "field: found ..., expected ..." unless `holds` is true.
template <class Found>
void require(bool holds, std::string_view field, const Found& found, std::string_view expected) {
  base::require(holds, field, "found {}, expected {}", found, expected);
}

/// Throws BadInput with the field's name if a member of `params` has a value that its field does
/// not allow.
template <class P>
void require_allowed(const base::Fields<P>& fields, const P& params) {
  for (const auto& field : fields) {
    const base::Scalar value = field.get(params);
    require(field.domain.allows(value), field.name, base::to_text(value), field.domain.describe());
  }
}

}  // namespace renderer

#pragma once
// Input checks. Errors are BadInput "found ..., expected ...".

#include "base/fields.hpp"

namespace renderer {

/// Throws unless `holds`. The caller adds the position.
template <class Found>
void require(bool holds, const Found& found, std::string_view expected) {
  if (!holds) throw base::BadInput(fmt::format("found {}, expected {}", found, expected));
}

/// Throws "field: found ..., expected ..." unless `holds`.
template <class Found>
void require(bool holds, std::string_view field, const Found& found, std::string_view expected) {
  base::require(holds, field, "found {}, expected {}", found, expected);
}

/// Throws if the declaration of a field forbids its value. The message has the field's name.
template <class P>
void require_allowed(const base::Fields<P>& fields, const P& params) {
  for (const auto& field : fields) {
    const base::Scalar value = field.get(params);
    require(field.domain.allows(value), field.name, base::to_text(value), field.domain.describe());
  }
}

/// Runs `action`. If it throws BadInput, puts `place` before the message.
template <class Action>
void at_place(std::string_view place, const Action& action) {
  try {
    action();
  } catch (const base::BadInput& bad) {
    throw base::BadInput(fmt::format("{}: {}", place, bad.what()));
  }
}

}  // namespace renderer

#pragma once
// Checks of input.

#include "base/errors.hpp"

namespace renderer {

/// Throws BadInput "found ..., expected ..." unless `holds`; whoever knows the place adds it.
template <class Found>
void require(bool holds, const Found& found, std::string_view expected) {
  if (!holds) throw base::BadInput(fmt::format("found {}, expected {}", found, expected));
}

/// Throws BadInput "field: found ..., expected ..." unless `holds`.
template <class Found>
void require(bool holds, std::string_view field, const Found& found, std::string_view expected) {
  if (!holds)
    throw base::BadInput(fmt::format("{}: found {}, expected {}", field, found, expected));
}

}  // namespace renderer

#pragma once
// Adds a place (a file, a line or a key) to the message of an error.
#include "base/errors.hpp"

namespace base {

/// Returns action(). If it throws BadInput, puts "place: " before the message.
template <class Action>
auto at_place(std::string_view place, const Action& action) {
  try {
    return action();
  } catch (const BadInput& error) {
    refuse(place, "{}", error.what());
  }
}

}  // namespace base

#pragma once
// Adds a place (a file, a line or a key) to the message of an error.
#include "base/errors.hpp"

namespace base {

/// Puts "place: " or, if the message already begins with "place:", nothing before the message.
inline std::string add_place(std::string_view place, std::string_view message) {
  const auto name = fmt::format("{}:", place);
  return message.starts_with(name) ? std::string(message) : fmt::format("{} {}", name, message);
}

/// Returns action(). If it throws BadInput, adds the place to the message (add_place).
template <class Action>
auto at_place(std::string_view place, const Action& action) {
  try {
    return action();
  } catch (const BadInput& error) {
    throw BadInput(add_place(place, error.what()));
  }
}

}  // namespace base

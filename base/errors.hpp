#pragma once
// Exceptions for bad input and broken invariants. Exceptions for simulated faults are in
// simulator/machine/faults.hpp.
#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace base {

/// Replaces each zero byte by the characters `\x00`, because std::exception::what() would end
/// there.
inline std::string show_zeros(std::string text) {
  for (std::size_t at = 0; (at = text.find('\0', at)) != text.npos;) text.replace(at, 1, "\\x00");
  return text;
}

/// Bad input. It is refused when it is read, before anything runs. The message names the file, line
/// or key, the value found and the value expected.
struct BadInput : std::runtime_error {
  explicit BadInput(std::string text) : std::runtime_error(show_zeros(std::move(text))) {}
};

/// A broken invariant, that is, a defect of tlab. The message has the values found and expected.
struct InvariantBroken : std::logic_error {
  using std::logic_error::logic_error;
};

/// Throws BadInput "place: message"; `place` is a file, a line or a key.
template <class... Args>
[[noreturn]] void refuse(std::string_view place, fmt::format_string<Args...> message,
                         Args&&... args) {
  throw BadInput(fmt::format("{}: {}", place, fmt::format(message, std::forward<Args>(args)...)));
}

/// Throws BadInput "place: message" unless `holds` is true.
template <class... Args>
void require(bool holds, std::string_view place, fmt::format_string<Args...> message,
             Args&&... args) {
  if (!holds) refuse(place, message, std::forward<Args>(args)...);
}

/// Throws InvariantBroken with both values unless they are equal.
template <class A, class B>
void check_equal(const char* what, const A& found, const B& expected) {
  if (!(found == expected))
    throw InvariantBroken(fmt::format("{}: found {}, expected {}", what, found, expected));
}

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

#include "base/fields.hpp"

#include <fmt/ranges.h>

#include <cmath>

namespace base {

namespace {

// Limits from this value on only reflect the range of the integer type, so descriptions omit them.
constexpr double LARGEST_SHOWN = 9e18;

// The value of a numeric scalar, converted to double.
double number_of(const Scalar& value) {
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? 1 : 0;
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  return std::get<double>(value);
}

}  // namespace

std::string to_text(const Scalar& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* list = std::get_if<std::vector<double>>(&value))
    return fmt::format("{}", fmt::join(*list, ", "));
  if (const auto* texts = std::get_if<std::vector<std::string>>(&value))
    return fmt::format("{}", fmt::join(*texts, ", "));
  if (const auto* rows = std::get_if<std::vector<std::vector<double>>>(&value))
    return fmt::format("{}", *rows);
  if (const auto* source = std::get_if<Source>(&value))
    return source->text.empty() ? "none" : source->text;
  return value.index() == 0 ? "none" : fmt::format("{}", number_of(value));
}

std::string Domain::describe() const {
  if (!expected.empty()) return expected;
  switch (kind) {
    case Kind::flag:
      return "true or false, or 1 or 0";
    case Kind::whole:
      return high < LARGEST_SHOWN ? fmt::format("a whole number from {} to {}", low, high)
                                  : fmt::format("a whole number, at least {}", low);
    case Kind::number:
      return fmt::format("a number from {} to {}", low, high);
    case Kind::choice:
      return fmt::format("one of {}", fmt::join(choices, ", "));
    case Kind::list:
      return "a list of numbers";
    case Kind::texts:
      return "a list of texts";
    case Kind::expression:
      return "a finite number, or an expression in quotes";
    default:
      return "a text in quotes";
  }
}

bool Domain::allows(const Scalar& value) const {
  const bool is_number =
      std::holds_alternative<std::int64_t>(value) || std::holds_alternative<double>(value);
  switch (kind) {
    case Kind::flag:
      return std::holds_alternative<bool>(value) ||
             (is_number && (number_of(value) == 0 || number_of(value) == 1));
    case Kind::whole:
    case Kind::number: {
      if (!is_number) return false;
      const double number = number_of(value);
      return number >= low && number <= high &&
             (kind == Kind::number || number == std::floor(number));
    }
    case Kind::choice: {
      const auto* text = std::get_if<std::string>(&value);
      return text && std::ranges::find(choices, *text) != choices.end();
    }
    case Kind::list:
      return std::holds_alternative<std::vector<double>>(value);
    case Kind::text:
    case Kind::expression:
      return std::holds_alternative<std::string>(value);
    case Kind::texts:
    case Kind::expressions:
      return std::holds_alternative<std::vector<std::string>>(value);
    case Kind::any:
      return value.index() != 0;
    default:
      return std::holds_alternative<Source>(value);
  }
}

}  // namespace base

#include "experiments/laboratory/file/expression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "base/errors.hpp"
#include "base/text.hpp"

namespace laboratory {
namespace {

using base::BadInput;
using base::trim;

// Removes one pair of quotes: 'tree' becomes tree.
std::string without_quotes(const std::string& text) {
  const bool is_quoted = text.size() > 2 && (text.front() == '"' || text.front() == '\'') &&
                         text.back() == text.front();
  return is_quoted ? text.substr(1, text.size() - 2) : text;
}

RowReference::Condition parse_condition(const std::string& text, const std::string& place) {
  const auto equals = text.find('=');
  RowReference::Condition condition{std::string(trim(text.substr(0, equals))), {}};
  if (equals != std::string::npos) condition.text = trim(text.substr(equals + 1));
  base::require(base::Formula::is_name(condition.axis) && !condition.text.empty(), place,
                "found \"{}\", expected AXIS = VALUE", text);
  try {
    condition.value.emplace(condition.text, place);
    // The condition is a string, not an expression. The class Rows refuses it if the axis is
    // numeric.
  } catch (const BadInput&) {
  }
  condition.text = without_quotes(condition.text);
  return condition;
}

// Parses a reference to another row, {COLUMN @ AXIS = VALUE, ...}, with its braces.
RowReference parse_reference(const std::string& text, const std::string& place) {
  const auto parts = base::split(std::string_view(text).substr(1, text.size() - 2), '@');
  base::require(parts.size() == 2 && base::Formula::is_name(std::string(parts[0])), place,
                "found {}, expected {{COLUMN @ AXIS = VALUE, ...}}", text);
  RowReference reference{text, std::string(parts[0]), {}};
  for (const auto text_of_one : base::split(parts[1], ',')) {
    auto condition = parse_condition(std::string(text_of_one), place + ": " + text);
    for (const auto& other : reference.conditions)
      base::require(other.axis != condition.axis, place + ": " + text, "found {} twice",
                    condition.axis);
    reference.conditions.push_back(std::move(condition));
  }
  return reference;
}

// Makes a valid name of a variable, which resembles the text so that errors remain readable.
std::string spell_as_name(std::string text) {
  for (char& c : text)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return "row" + text;
}

}  // namespace

Expression::Expression(const std::string& text, const std::string& place)
    : formula_(replace_references(text, place), place) {}

std::string Expression::replace_references(const std::string& text, const std::string& place) {
  base::require(text.size() <= base::Formula::MAX_BYTES, place,
                "found an expression of {} bytes, expected at most {}", text.size(),
                base::Formula::MAX_BYTES);
  std::string replaced;
  std::size_t begin = 0;
  for (auto open = text.find('{'); open != std::string::npos; open = text.find('{', begin)) {
    const auto close = text.find('}', open);
    base::require(close != std::string::npos, place, "found \"{}\", expected a }} for each {{",
                  text);
    auto reference = parse_reference(text.substr(open, close + 1 - open), place);
    auto name = spell_as_name(reference.text);
    const auto is_taken = [&] {
      const auto* other = find_reference(name);
      return other && other->text != reference.text;
    };
    while (is_taken()) name += '_';
    replaced += text.substr(begin, open - begin) + name;
    references_.emplace(name, std::move(reference));
    begin = close + 1;
  }
  return replaced + text.substr(begin);
}

const RowReference* Expression::find_reference(const std::string& variable) const {
  const auto found = references_.find(variable);
  return found == references_.end() ? nullptr : &found->second;
}

std::vector<std::string> Expression::names() const {
  std::vector<std::string> names;
  for (const auto& variable : variables())
    if (!find_reference(variable)) names.push_back(variable);
  for (const auto& [variable, reference] : references_) {
    names.push_back(reference.column);
    for (const auto& condition : reference.conditions)
      if (condition.value)
        std::ranges::copy(condition.value->variables(), std::back_inserter(names));
  }
  return names;
}

}  // namespace laboratory

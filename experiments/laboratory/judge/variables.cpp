#include "experiments/laboratory/judge/variables.hpp"

#include <fmt/format.h>

#include <cctype>
#include <limits>

#include "base/errors.hpp"
#include "base/spelling.hpp"

namespace laboratory {

namespace {

constexpr double NO_VALUE = std::numeric_limits<double>::quiet_NaN();

std::string spell_as_name(std::string text) {
  for (char& c : text)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.') c = '_';
  return text;
}

}  // namespace

Variables::Variables(const Point& point, const machine::Model& model) : numbers_(point.numbers) {
  for (const auto& entry : model.entries) numbers_[entry.key] = entry.value;
}

void Variables::add_row(const Table& table, const std::vector<Value>& row) {
  for (std::size_t c = 0; c < row.size(); ++c)
    if (const auto* text = std::get_if<std::string>(&row[c]))
      texts_[table.columns[c]] = *text;
    else
      numbers_[table.columns[c]] = as_number(row[c]).value_or(NO_VALUE);
}

void Variables::add(const std::string& name, double value, const std::string& place) {
  if (numbers_.contains(name) || texts_.contains(name))
    throw base::BadInput(
        fmt::format("{}: there is a {} already, expected a new name", place, name));
  numbers_[name] = value;
}

std::optional<double> Variables::compare_text(const std::string& name) const {
  for (const auto& [column, text] : texts_) {
    const auto prefix = spell_as_name(column) + "_is_";
    if (name.starts_with(prefix)) return prefix + spell_as_name(text) == name ? 1 : 0;
  }
  return std::nullopt;
}

double Variables::get(const std::string& name, const std::string& place) const {
  if (const auto found = numbers_.find(name); found != numbers_.end()) return found->second;
  if (const auto equal = compare_text(name)) return *equal;
  if (const auto text = texts_.find(name); text != texts_.end())
    throw base::BadInput(fmt::format("{}: {} is a text, expected a comparison such as {}_is_{}",
                                     place, name, spell_as_name(name),
                                     spell_as_name(text->second)));
  std::vector<std::string> known;
  for (const auto& [key, value] : numbers_) known.push_back(key);
  throw base::BadInput(fmt::format("{}: unknown variable \"{}\", the nearest is \"{}\"", place,
                                   name, base::nearest_name(name, known)));
}

std::vector<double> Variables::get_all(const std::vector<std::string>& names,
                                       const std::string& place) const {
  std::vector<double> values;
  for (const auto& name : names) values.push_back(get(name, place));
  return values;
}

}  // namespace laboratory

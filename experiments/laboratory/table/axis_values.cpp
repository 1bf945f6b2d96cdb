#include "experiments/laboratory/table/axis_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace laboratory {
namespace {

// Formats the value of an axis: "3200 objects", "tree", "depth 3", "link rate 20 Mbit/s".
std::string name_value(const std::string& axis, const Value& value) {
  const auto text = to_string(value), label = make_label(axis);
  if (!as_number(value) && text != "true" && text != "false") return text;
  const auto unit = label.rfind(" [");
  if (unit != std::string::npos)
    return fmt::format("{} {} {}", label.substr(0, unit), text,
                       label.substr(unit + 2, label.size() - unit - 3));
  if (!label.ends_with('s')) return fmt::format("{} {}", label, text);
  const std::size_t plural = label.ends_with("ches") ? 2 : 1;
  return fmt::format("{} {}", text, text == "1" ? label.substr(0, label.size() - plural) : label);
}

}  // namespace

RowList all_rows(const Table& table) {
  RowList rows(table.rows.size());
  std::iota(rows.begin(), rows.end(), 0);
  return rows;
}

std::vector<Value> distinct(const Table& table, const RowList& rows, std::size_t column) {
  std::vector<Value> values;
  for (const auto row : rows) {
    const Value& value = table.rows[row].at(column);
    if (std::holds_alternative<std::monostate>(value)) continue;
    if (std::ranges::find(values, value) == values.end()) values.push_back(value);
  }
  return values;
}

bool is_determined(const Table& table, const RowList& rows, std::size_t axis,
                   const std::vector<std::size_t>& others) {
  std::map<std::vector<Value>, Value> known;
  for (const auto row : rows) {
    std::vector<Value> at;
    for (const auto other : others) at.push_back(table.rows[row][other]);
    const auto& value = table.rows[row][axis];
    if (known.emplace(at, value).first->second != value) return false;
  }
  return !others.empty();
}

std::string name_values(const Table& table, std::size_t row, const std::vector<std::size_t>& axes) {
  std::string name;
  for (const auto axis : axes) {
    const auto& value = table.rows[row][axis];
    if (std::holds_alternative<std::monostate>(value)) continue;
    name += (name.empty() ? "" : ", ") + name_value(table.columns[axis], value);
  }
  return name;
}

bool is_geometric(const std::vector<double>& values) {
  if (values.empty()) return false;
  const auto [smallest, largest] = std::ranges::minmax(values);
  return smallest > 0 && largest / smallest >= 16;
}

std::vector<double> numbers_of(const Table& table, const RowList& rows, std::size_t column) {
  std::vector<double> numbers;
  for (const auto row : rows)
    if (const auto number = as_number(table.rows[row][column])) numbers.push_back(*number);
  return numbers;
}

}  // namespace laboratory

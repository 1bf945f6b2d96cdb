// Which rows of a table are meant.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "experiments/laboratory/judge/check_plan.hpp"

namespace laboratory {

namespace {

constexpr std::size_t MOST_NAMED = 5;  // rows in one note

std::string join_few(std::vector<std::string> names) {
  const auto count = names.size();
  names.resize(std::min(count, MOST_NAMED));
  return fmt::format("{}{}", fmt::join(names, "; "), count > MOST_NAMED ? "; ..." : "");
}

}  // namespace

std::string name_row(const Table& table, const std::vector<Value>& row,
                     const std::vector<std::string>& columns) {
  std::vector<std::string> parts;
  for (const auto& column : columns)
    parts.push_back(fmt::format("{} = {}", column, to_string(row[*table.find(column)])));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string name_axes(const Table& table, std::size_t row) {
  return name_row(
      table, table.rows[row],
      {table.columns.begin(), table.columns.begin() + static_cast<std::ptrdiff_t>(table.axes)});
}

std::vector<std::size_t> choose_rows(const Rows& rows, const std::optional<Expression>& where) {
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < rows.table().rows.size(); ++i) {
    if (!rows.is_complete(i)) continue;
    const double holds = where ? rows.eval(*where, i).value_or(0) : 1;
    if (std::isnan(holds))
      throw base::BadInput(
          fmt::format("{}: found nan at some point, expected a number", where->place()));
    if (holds != 0) chosen.push_back(i);
  }
  return chosen;
}

std::vector<std::vector<std::size_t>> match_rows(const Table& reference, const Table& table,
                                                 const std::vector<std::string>& keys) {
  std::vector<std::vector<std::size_t>> matches;
  for (const auto& row : reference.rows) {
    auto& found = matches.emplace_back();
    for (std::size_t i = 0; i < table.rows.size(); ++i)
      if (std::ranges::all_of(keys, [&](const auto& key) {
            return is_same(table.rows[i][*table.find(key)], row[*reference.find(key)]);
          }))
        found.push_back(i);
  }
  return matches;
}

std::optional<std::string> note_missing(const Table& reference, const std::string& name,
                                        const std::string& column,
                                        const std::vector<std::string>& keys,
                                        const std::vector<std::vector<std::size_t>>& matches) {
  std::vector<std::string> missing;
  for (std::size_t i = 0; i < matches.size(); ++i)
    if (matches[i].empty() && as_number(reference.rows[i][*reference.find(column)]))
      missing.push_back(name_row(reference, reference.rows[i], keys));
  if (missing.empty()) return std::nullopt;
  return fmt::format("{} row(s) of {} were not run: {}", missing.size(), name, join_few(missing));
}

std::optional<std::string> note_left_out(const Table& table, const std::vector<std::size_t>& rows) {
  if (rows.empty()) return std::nullopt;
  std::vector<std::string> names;
  for (const auto row : rows) names.push_back(name_axes(table, row));
  return fmt::format("{} point(s) left out, for want of another point that they need: {}",
                     rows.size(), join_few(names));
}

}  // namespace laboratory

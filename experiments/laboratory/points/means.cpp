#include "experiments/laboratory/points/means.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>

#include "experiments/laboratory/points/results.hpp"
#include "experiments/laboratory/table/samples.hpp"
#include "experiments/laboratory/table/statistics.hpp"

namespace laboratory {
namespace {

// Chooses the rows of completed points, or all rows if no point was completed.
RowList choose_complete(const Table& table, const RowList& rows) {
  RowList complete;
  std::ranges::copy_if(rows, std::back_inserter(complete),
                       [&](auto row) { return is_complete_row(table, table.rows[row]); });
  return complete.empty() ? rows : complete;
}

// The numbers of a column; no value if a cell is a text or a number is not finite.
std::optional<std::vector<double>> find_finite(const Table& table, const RowList& rows,
                                               std::size_t column) {
  std::vector<double> numbers;
  for (const auto row : rows) {
    const auto& cell = table.rows[row][column];
    if (cell == Value()) continue;
    const auto number = as_number(cell);
    if (!number || !std::isfinite(*number)) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers;
}

// The value that a column has in all these rows; an empty cell if the values differ.
Value find_common(const Table& table, const RowList& rows, std::size_t column) {
  const auto& first = table.rows[rows[0]][column];
  const bool is_common =
      std::ranges::all_of(rows, [&](auto row) { return is_same(table.rows[row][column], first); });
  return is_common ? first : Value();
}

Value find_end(const Table& table, const RowList& rows, std::size_t column) {
  for (const auto row : rows)
    if (!is_complete_row(table, table.rows[row])) return table.rows[row][column];
  return table.rows[rows[0]][column];
}

// The mean of a column over the rows of a group. Also returns the half width of its confidence
// interval if the samples differ.
std::pair<Value, std::optional<double>> find_cell(const Table& table, const RowList& rows,
                                                  std::size_t column) {
  if (table.columns[column] == "ended") return {find_end(table, rows, column), {}};
  const auto complete = choose_complete(table, rows);
  const auto common = find_common(table, complete, column);
  if (common != Value() || column < table.axes) return {common, {}};
  const auto numbers = find_finite(table, complete, column);
  if (!numbers || numbers->empty()) return {};
  const auto found = find_mean_interval(*numbers);
  return {found.mean, found.half_width};
}

}  // namespace

Table average_seeds(const Table& table) {
  const auto seeds = find_seeds(table);
  if (seeds.empty()) return table;
  std::vector<std::size_t> kept;
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    if (std::ranges::find(seeds, c) == seeds.end()) kept.push_back(c);
  Table means;
  means.axes = table.axes - seeds.size();
  for (const auto c : kept) means.columns.push_back(table.columns[c]);
  means.columns.emplace_back(SEEDS);
  const auto groups = group_samples(table, all_rows(table));
  // half width of each mean: by row of the table of means, then by kept column
  std::vector<std::vector<std::optional<double>>> half_widths;
  // indices in `kept` of columns whose samples differ
  std::set<std::size_t> spread;
  for (const auto& rows : groups) {
    auto& row = means.rows.emplace_back();
    auto& halves = half_widths.emplace_back();
    means.points.push_back(table.point_of(rows[0]));
    for (std::size_t i = 0; i < kept.size(); ++i) {
      auto [mean, half] = find_cell(table, rows, kept[i]);
      row.push_back(std::move(mean));
      halves.push_back(half);
      if (half) spread.insert(i);
    }
    row.emplace_back(static_cast<std::int64_t>(choose_complete(table, rows).size()));
  }
  for (const auto i : spread) {
    means.columns.push_back(table.columns[kept[i]] + HALF_WIDTH);
    for (std::size_t r = 0; r < groups.size(); ++r) {
      // all cells of a column of means become floating-point numbers, even where the mean is an
      // integer
      if (const auto whole = as_number(means.rows[r][i])) means.rows[r][i] = *whole;
      auto& cell = means.rows[r].emplace_back();
      if (means.rows[r][i] != Value() && groups[r].size() > 1) cell = half_widths[r][i].value_or(0);
    }
  }
  return means;
}

std::string describe_seeds(const Table& table) {
  const auto seeds = name_seeds(table);
  if (seeds.empty()) return seeds;
  const auto& columns = average_seeds(table).columns;
  const bool has_effect = std::ranges::any_of(
      columns, [](const std::string& name) { return name.ends_with(HALF_WIDTH); });
  if (!has_effect) return fmt::format("The seed has no effect: all results agree for {}.", seeds);
  return fmt::format("Means over {}; ± is half the width of the 95 % confidence interval.", seeds);
}

Table make_means_csv(const ExperimentFile& file, const Table& table) {
  const auto seeds = find_seeds(table);
  Table csv;
  if (seeds.empty()) return csv;
  std::vector<std::size_t> axes;
  for (std::size_t axis = 0; axis < table.axes; ++axis)
    if (std::ranges::find(seeds, axis) == seeds.end()) axes.push_back(axis);
  for (const auto axis : axes) csv.columns.push_back(table.columns[axis]);
  csv.axes = axes.size() + 1;
  for (const char* column : {"result", "samples", "mean", "deviation", "low_95", "high_95"})
    csv.columns.emplace_back(column);
  const auto inputs = input_names(file, table);
  for (const auto& rows : group_samples(table, all_rows(table)))
    for (std::size_t c = table.axes; c < table.columns.size(); ++c) {
      const auto numbers = find_finite(table, choose_complete(table, rows), c);
      if (!numbers || numbers->empty() || inputs.contains(table.columns[c])) continue;
      auto& row = csv.rows.emplace_back();
      for (const auto axis : axes) row.push_back(table.rows[rows[0]][axis]);
      const auto found = find_mean_interval(*numbers);
      row.emplace_back(table.columns[c]);
      row.emplace_back(static_cast<std::int64_t>(found.samples));
      row.emplace_back(found.mean);
      row.resize(csv.columns.size());
      if (!found.half_width) continue;
      const auto last = row.size() - 1;
      row[last - 2] = *found.half_width == 0 ? 0 : find_deviation(*numbers);
      row[last - 1] = found.low();
      row[last] = found.high();
    }
  return csv;
}

}  // namespace laboratory

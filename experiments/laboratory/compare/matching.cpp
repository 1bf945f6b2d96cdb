#include "experiments/laboratory/compare/matching.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/errors.hpp"
#include "experiments/laboratory/table/axis_values.hpp"
#include "experiments/laboratory/table/samples.hpp"

namespace laboratory {
namespace {

using Texts = std::vector<std::string>;

std::optional<std::size_t> find_axis(const Table& table, const std::string& name) {
  const auto column = table.find(name);
  return column && *column < table.axes ? column : std::nullopt;
}

bool varies(const Table& table, const std::string& axis) {
  const auto column = find_axis(table, axis);
  return column && distinct(table, all_rows(table), *column).size() > 1;
}

// The axes that take several values in at least one run, in the order in which they appear first.
Texts find_varying(const std::vector<NamedTable>& runs) {
  Texts found;
  for (const auto& run : runs)
    for (std::size_t i = 0; i < run.table.axes; ++i)
      if (const auto& axis = run.table.columns[i];
          varies(run.table, axis) && std::ranges::find(found, axis) == found.end())
        found.push_back(axis);
  return found;
}

void check_everywhere(const std::vector<NamedTable>& runs, const std::string& axis) {
  const auto has = [&](const NamedTable& run) { return find_axis(run.table, axis).has_value(); };
  const auto without = std::ranges::find_if_not(runs, has);
  if (without == runs.end()) return;
  throw base::BadInput(
      fmt::format("found the axis {} with several values in {} but not in {}, expected the same "
                  "axes in all runs",
                  axis, std::ranges::find_if(runs, has)->name, without->name));
}

// Throws if the seed `other` varies and is not determined by the seed `seed`. A grid of two seeds
// contains points that share the value of a seed, and these are not independent samples. Two seeds
// that always change together are valid.
void check_coupled(const std::vector<NamedTable>& runs, const std::string& seed,
                   const std::string& other) {
  for (const auto& [name, table] : runs) {
    if (!varies(table, other)) continue;
    const auto a = find_axis(table, seed), b = find_axis(table, other);
    if (!a || !is_determined(table, all_rows(table), *b, {*a}))
      throw base::BadInput(
          fmt::format("found two seeds with several values, {} and {}, in {}, expected one: its "
                      "values are the samples",
                      seed, other, name));
  }
}

using Key = std::vector<std::string>;

// The values of the axes in a row, spelled so that 2 and 2.0 are equal.
Key key_of(const Table& table, std::size_t row, const Texts& axes) {
  Key key;
  for (const auto& axis : axes) {
    const auto& cell = table.rows[row][*table.find(axis)];
    const auto number = as_number(cell);
    key.push_back(to_string(number ? to_cell(*number) : cell));
  }
  return key;
}

[[noreturn]] void throw_apart(const MatchedRuns& matched) {
  Texts texts;
  for (const auto& axis : matched.axes)
    for (const auto& [name, table] : matched.runs) {
      Texts values;
      for (const auto& value : distinct(table, all_rows(table), *table.find(axis)))
        values.push_back(to_string(value));
      texts.push_back(fmt::format("{} is {} in {}", axis, join_texts(values, ", "), name));
    }
  throw base::BadInput(fmt::format("found no point that all runs have ({}), expected at least one",
                                   join_texts(texts, "; ")));
}

}  // namespace

MatchedRuns match_points(std::vector<NamedTable> runs) {
  MatchedRuns matched;
  matched.runs = std::move(runs);
  for (const auto& axis : find_varying(matched.runs))
    if (!is_seed(axis)) {
      check_everywhere(matched.runs, axis);
      matched.axes.push_back(axis);
    } else if (matched.seed.empty()) {
      matched.seed = axis;
    } else {
      check_coupled(matched.runs, matched.seed, axis);
    }

  std::map<Key, std::vector<std::vector<std::size_t>>> rows_at;
  for (std::size_t r = 0; r < matched.runs.size(); ++r) {
    const Table& table = matched.runs[r].table;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
      auto& rows = rows_at[key_of(table, row, matched.axes)];
      rows.resize(matched.runs.size());
      rows[r].push_back(row);
    }
  }
  matched.left_out.resize(matched.runs.size());
  for (auto& [key, rows] : rows_at)
    if (!std::ranges::all_of(rows, [](const auto& of_run) { return !of_run.empty(); }))
      for (std::size_t r = 0; r < rows.size(); ++r) matched.left_out[r] += rows[r].size();
    else
      matched.points.push_back({{}, std::move(rows)});
  if (matched.points.empty()) throw_apart(matched);
  std::ranges::sort(matched.points, {}, [](const auto& point) { return point.rows[0][0]; });
  const Table& first = matched.runs[0].table;
  for (auto& point : matched.points)
    for (const auto& axis : matched.axes)
      point.at.push_back(first.rows[point.rows[0][0]][*first.find(axis)]);
  return matched;
}

std::string name_point(const MatchedRuns& matched, const MatchedRuns::Point& point) {
  Texts parts;
  for (std::size_t i = 0; i < matched.axes.size(); ++i)
    parts.push_back(fmt::format("{} = {}", matched.axes[i], to_string(point.at[i])));
  return join_texts(parts, ", ");
}

}  // namespace laboratory

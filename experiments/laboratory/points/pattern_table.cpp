#include "experiments/laboratory/points/pattern_table.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/errors.hpp"
#include "experiments/laboratory/file/program.hpp"
#include "experiments/laboratory/points/point_result.hpp"
#include "experiments/laboratory/points/results.hpp"
#include "experiments/laboratory/points/speedups.hpp"

namespace laboratory {

namespace {

using nlohmann::ordered_json;

constexpr double EXACT = 0x1p53;  // up to here doubles hold every whole number

// Adds a cell, and its column where that is new.
void put(Table& table, std::vector<Value>& row, const std::string& column, const Value& value) {
  const auto known = table.find(column);
  if (!known) table.columns.push_back(column);
  if (!known || *known == row.size()) return row.push_back(value);
  if (*known > row.size())
    throw base::InvariantBroken(
        fmt::format("column {} of one point is not where it is at another", column));
  const auto found = as_number(value), expected = as_number(row[*known]);
  base::check_equal(("two columns " + column).c_str(), found.value_or(0), expected.value_or(0));
}

// What goes into a point and is no axis.
void put_inputs(Table& table, std::vector<Value>& row, const Experiment& experiment,
                const ordered_json& result) {
  const auto& pattern = *find_pattern(experiment.program);
  if (pattern.uses_topology) {
    put(table, row, "topology", experiment.topology);
    put(table, row, "processors", to_value(result["processors"]));
  }
  for (const auto& p : pattern.parameters)
    if (p.is_path)
      put(table, row, p.name, experiment.files.at(p.name).text);
    else
      put(table, row, p.name,
          p.choices.empty() ? Value(experiment.parameters.at(p.name))
                            : Value(describe_value(p, experiment)));
}

// Whole numbers are written without a point, if a column holds nothing else.
void make_whole(Table& table) {
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const bool whole = std::ranges::all_of(table.rows, [&](const auto& row) {
      const auto* number = std::get_if<double>(&row[c]);
      return !number || (*number == std::floor(*number) && std::abs(*number) < EXACT);
    });
    for (auto& row : table.rows)
      if (const auto* number = std::get_if<double>(&row[c]); number && whole)
        row[c] = static_cast<std::int64_t>(*number);
  }
}

}  // namespace

Table make_pattern_table(const ExperimentFile& file, const std::vector<ordered_json>& results) {
  Table table;
  table.columns = axis_columns(file);
  const auto& parts = find_pattern(file.points[0].experiment.program)->parts;
  table.columns.insert(table.columns.end(), parts.begin(), parts.end());
  table.axes = table.columns.size();
  const auto& longest = longest_row(results);
  for (std::size_t i = 0; i < results.size(); ++i)
    for (const auto* measured : rows_of(results[i])) {
      std::vector<Value> row;
      for (const auto& at : file.points[i].at) row.push_back(to_value(at));
      for (const auto& part : parts) row.push_back(to_value(measured->value(part, ordered_json())));
      put_inputs(table, row, file.points[i].experiment, results[i]);
      for (const auto& [name, ignored] : longest.items())
        put(table, row, name, to_value(measured->value(name, ordered_json())));
      put(table, row, "ended", to_value(results[i]["ended"]));
      base::check_equal("columns of a pattern", row.size(), table.columns.size());
      table.rows.push_back(std::move(row));
      table.points.push_back(i);
    }
  add_speedups(table, "processors");
  make_whole(table);
  return table;
}

std::vector<std::string> first_result(const ExperimentFile& file, const Table& table) {
  std::set<std::string> inputs{"topology", "processors"};
  for (std::size_t c = 0; c < table.axes; ++c) inputs.insert(table.columns[c]);
  for (const auto& p : find_pattern(file.points[0].experiment.program)->parameters)
    inputs.insert(p.name);
  for (const auto& column : table.columns)
    if (!inputs.contains(column)) return {column};
  return {};
}

}  // namespace laboratory

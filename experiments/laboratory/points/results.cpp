#include "experiments/laboratory/points/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "experiments/laboratory/points/farm_run.hpp"
#include "experiments/laboratory/points/pattern_table.hpp"
#include "experiments/laboratory/points/point_result.hpp"
#include "experiments/laboratory/points/speedups.hpp"
#include "experiments/laboratory/table/laws.hpp"

namespace laboratory {

namespace {

using nlohmann::ordered_json;

bool is_standard(const std::string& axis) {
  return axis == "topology" || axis == "workers" || axis == "objects";
}

// What the laws say of every speed-up, behind the efficiency.
void add_serial_fractions(Table& table) {
  const std::size_t workers = *table.find("workers"), speedup = *table.find("speedup");
  auto behind = static_cast<std::ptrdiff_t>(*table.find("efficiency")) + 1;
  for (const auto& [name, law] : {std::pair("serial_karp_flatt", &karp_flatt),
                                  std::pair("serial_gustafson", &serial_gustafson)}) {
    table.columns.insert(table.columns.begin() + behind, name);
    for (auto& row : table.rows) {
      const auto n = as_number(row[workers]), s = as_number(row[speedup]);
      const auto serial = n && s ? law(*n, *s) : std::nullopt;
      Value cell;
      if (serial) cell = *serial;
      row.insert(row.begin() + behind, cell);
    }
    ++behind;
  }
}

}  // namespace

bool is_complete_row(const Table& table, const std::vector<Value>& row) {
  const auto column = table.find("ended");
  return !column || row[*column] == Value("done") || row[*column] == Value("saturated");
}

bool is_farm(const ExperimentFile& file) { return file.points[0].experiment.program == "farm"; }

Value to_value(const ordered_json& json) {
  if (json.is_null()) return {};
  if (json.is_number_integer()) return json.get<std::int64_t>();
  if (json.is_number()) return json.get<double>();
  return json.get<std::string>();
}

// A coordinate without TOML's quotes; numbers as numbers.
Value to_value(const Coordinate& at) {
  const auto json = ordered_json::parse(at.toml, nullptr, false);
  if (json.is_number()) return to_value(json);
  const auto& text = at.toml;
  const bool quoted = text.size() >= 2 && (text.front() == '"' || text.front() == '\'');
  return quoted ? text.substr(1, text.size() - 2) : text;
}

// What the axis of a name is called in the table.
static std::string column_of(const ExperimentFile& file, const std::string& axis) {
  return !is_farm(file) && axis == "workers" ? "processors" : axis;
}

std::vector<std::string> find_coupled(const ExperimentFile& file, const std::string& column) {
  for (const auto& axes : file.coupled) {
    std::vector<std::string> columns;
    for (const auto& axis : axes) columns.push_back(column_of(file, axis));
    if (std::ranges::find(columns, column) != columns.end()) return columns;
  }
  return {column};
}

const ordered_json& longest_row(const std::vector<ordered_json>& results) {
  std::vector<const ordered_json*> all;
  for (const auto& result : results)
    for (const auto* row : rows_of(result)) all.push_back(row);
  return **std::ranges::max_element(all, {}, [](const auto* row) { return row->size(); });
}

std::vector<std::string> axis_columns(const ExperimentFile& file) {
  std::vector<std::string> columns;
  if (is_farm(file)) columns = {"topology", "workers", "objects"};
  for (const auto& axis : file.axes)
    if (!is_farm(file) || !is_standard(axis)) columns.push_back(column_of(file, axis));
  return columns;
}

Table make_table(const ExperimentFile& file, const std::vector<ordered_json>& results) {
  if (!is_farm(file)) return make_pattern_table(file, results);
  Table table;
  table.columns = axis_columns(file);
  table.axes = table.columns.size();
  const auto& longest = longest_row(results);
  for (const auto& [name, value] : longest.items()) table.columns.push_back(name);
  for (std::size_t i = 0; i < results.size(); ++i) {
    const Point& point = file.points[i];
    std::vector<Value> row{point.experiment.topology, to_value(results[i]["workers"]),
                           to_value(results[i]["objects"])};
    for (const auto& at : point.at)
      if (!is_standard(at.axis)) row.push_back(to_value(at));
    for (const auto& [name, ignored] : longest.items())
      row.push_back(to_value(results[i]["row"].value(name, ordered_json())));
    table.rows.push_back(std::move(row));
  }
  add_speedups(table, "workers");
  add_serial_fractions(table);
  return table;
}

std::string image_key(const Experiment& experiment) {
  const auto& p = experiment.farm.image;
  return fmt::format("{} {}x{} {} {} {} {} {} {},{},{},{}", scene_source(experiment), p.width,
                     p.height, p.limits.depth, p.limits.min_influence, int(p.feelers),
                     int(p.sample), p.ambient, p.area.x, p.area.y, p.area.width, p.area.height);
}

std::string stages_key(const Experiment& experiment) {
  std::string key;
  for (const auto& s : experiment.farm.stages)
    key += fmt::format(" {} {} {} {} {},{},{},{}", s.min_influence, s.depth_reflected,
                       s.depth_transmitted, s.min_cell, s.area.x, s.area.y, s.area.width,
                       s.area.height);
  return key;
}

std::string image_name(const Experiment& experiment) {
  std::string name = std::filesystem::path(scene_source(experiment)).filename().string();
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '-';
  return "image-" + name;
}

}  // namespace laboratory

#include "experiments/laboratory/points/dictionary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <regex>

namespace laboratory {
namespace {

using nlohmann::ordered_json;

// True if the name `named` of a program's column stands for `column`. A name with a placeholder,
// such as "stage{}_s", stands for several columns.
bool is_called(const std::string& column, std::string named) {
  const auto gap = named.find("{}");
  if (gap == std::string::npos) return column == named;
  return std::regex_match(column, std::regex(named.replace(gap, 2, "[0-9]+")));
}

struct Meaning {
  std::string text{}, unit{};
  bool is_flag = false;                 // true if the values are only 0 and 1
  std::vector<std::string> programs{};  // programs that produce the column; empty: all programs
};

// Finds the program's description of a column that is one of its results or parameters.
Meaning find_in(const programs::Program& program, const std::string& column) {
  for (const auto& [name, help] : program.columns)
    if (is_called(column, name)) return {help, unit_of(column)};
  for (const auto& p : program.parameters)
    if (p.name == column || p.name.ends_with("." + column))
      return {p.help, p.unit, p.domain.kind == base::Domain::Kind::flag};
  return {};
}

// The help text of the key that an axis sets. The axis is found by its column.
std::string find_axis_help(const ExperimentFile& file, const std::string& column) {
  const auto all = settings();
  for (const auto& axis : file.axes()) {
    const auto setting = std::ranges::find(all, axis.key, &Setting::key);
    if (axis.name == column && setting != all.end()) return setting->help;
  }
  return "";
}

Meaning find_meaning(const ExperimentFile& file, const std::string& column) {
  Meaning meaning{"", unit_of(column)};
  std::string texts;  // the programs' descriptions, joined; used if they differ
  bool is_same = true;
  for (const auto& point : file.points) {
    const auto& program = *point.experiment.program;
    const auto found = find_in(program, column);
    if (found.text.empty() ||
        std::ranges::find(meaning.programs, program.name) != meaning.programs.end())
      continue;
    if (meaning.text.empty()) meaning = found;
    is_same = is_same && found.text == meaning.text;
    texts += fmt::format("{}{}: {}", texts.empty() ? "" : "; ", program.name, found.text);
    meaning.programs.push_back(program.name);
  }
  if (!is_same) meaning.text = texts;
  if (meaning.text.empty()) meaning.text = find_axis_help(file, column);
  if (!meaning.text.empty()) return meaning;
  for (const auto& baseline : file.baselines)
    if (column == baseline.column())
      meaning.text = baseline.of + " at " + baseline.at + " over the row's own";
  if (column == "ended") meaning.text = "done, or the reason why the point did not complete";
  if (column == "topology") meaning.text = "topology of the network";
  if (column == file.points[0].experiment.program->processors)
    meaning.text = "processors of the network that do the work";
  return meaning;
}

// The column's type in the schema; "any" for a column without values.
std::string find_type(const Table& table, std::size_t column) {
  if (std::ranges::all_of(table.rows, [&](const auto& row) { return row[column] == Value(); }))
    return "any";
  const auto all = [&](const auto& is_it) {
    return std::ranges::all_of(
        table.rows, [&](const auto& row) { return row[column] == Value() || is_it(row[column]); });
  };
  if (all([](const Value& v) { return std::holds_alternative<std::int64_t>(v); })) return "integer";
  return all([](const Value& v) { return !std::holds_alternative<std::string>(v); }) ? "number"
                                                                                     : "string";
}

}  // namespace

ordered_json make_dictionary(const ExperimentFile& file, const Table& table) {
  ordered_json fields = ordered_json::array(), key = ordered_json::array();
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const auto& name = table.columns[c];
    if (c < table.axes) key.push_back(name);
    const auto [text, unit, is_flag, programs] = find_meaning(file, name);
    ordered_json field = {{"name", name},
                          {"type", is_flag ? "boolean" : find_type(table, c)},
                          {"title", without_unit(make_label(name))}};
    if (!unit.empty()) field["unit"] = unit;
    if (!text.empty()) field["description"] = text;
    if (!programs.empty()) field["programs"] = programs;
    fields.push_back(std::move(field));
  }
  return {{"fields", fields}, {"missingValues", ordered_json::array({""})}, {"primaryKey", key}};
}

}  // namespace laboratory

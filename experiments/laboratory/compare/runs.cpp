#include "experiments/laboratory/compare/runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/errors.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/points/origin.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;

using Texts = std::vector<std::string>;

// The parts of a path, without "." and an empty last one.
Texts parts_of(const std::string& folder) {
  Texts parts;
  for (const auto& part : fs::absolute(folder).lexically_normal())
    if (!part.empty()) parts.push_back(part.string());
  return parts;
}

// The last `count` parts of a path.
std::string end_of(const Texts& parts, std::size_t count) {
  const auto from = parts.size() - std::min(count, parts.size());
  return join_texts({parts.begin() + static_cast<std::ptrdiff_t>(from), parts.end()}, "/");
}

Texts find_names(const Texts& folders) {
  std::vector<Texts> parts;
  for (const auto& folder : folders) parts.push_back(parts_of(folder));
  Texts names;
  for (std::size_t i = 0; i < folders.size(); ++i) {
    std::size_t count = 1;
    const auto is_taken = [&](const Texts& other) {
      return &other != &parts[i] && end_of(other, count) == end_of(parts[i], count);
    };
    while (count < parts[i].size() && std::ranges::any_of(parts, is_taken)) ++count;
    names.push_back(end_of(parts[i], count));
  }
  return names;
}

ComparedRun load_run(const std::string& folder, const std::string& name) {
  const auto file = fs::path(folder) / "run.json";
  const Origin origin = load_origin(folder, "run.json");
  try {
    ComparedRun run{.folder = folder,
                    .name = name,
                    .command = command_line(origin.options),
                    .simulation = load_simulation(folder, origin.file),
                    .record = nlohmann::ordered_json::parse(base::read_text(file))};
    run.record.erase("points");
    return run;
  } catch (const nlohmann::json::exception& error) {
    throw make_damaged(file, error);
  } catch (const base::BadInput& error) {
    throw base::BadInput(fmt::format("{}: {}", folder, error.what()));
  }
}

// A value without TOML's quotes.
std::string unquote(const std::string& text) {
  const bool is_quoted = text.size() > 1 && text.front() == text.back() &&
                         (text.front() == '"' || text.front() == '\'');
  return is_quoted ? text.substr(1, text.size() - 2) : text;
}

// What a key is where the file says nothing of it.
std::string default_of(const ExperimentFile& file, const std::string& key) {
  const Experiment& e = file.points[0].experiment;
  if (key == "machine.model") return e.model.source.text;
  if (key == "network.topology") return e.topology.text;
  if (key == "network.workers") return std::to_string(e.workers);
  for (const auto& p : e.program->parameters)
    if (programs::key_of(p) == key) return base::to_text(p.get(e.params));
  return "by default";
}

std::string value_of(const ExperimentFile& file, const std::string& key) {
  if (const auto given = file.settings.find(key); given != file.settings.end())
    return unquote(given->second);
  const auto axis = std::ranges::find(file.axis_keys, key);
  if (axis == file.axis_keys.end()) return default_of(file, key);
  const auto number = static_cast<std::size_t>(axis - file.axis_keys.begin());
  Texts values;
  for (const auto& point : file.points)
    if (const auto value = unquote(point.at[number].toml);
        std::ranges::find(values, value) == values.end())
      values.push_back(value);
  return fmt::format("[{}]", join_texts(values, ", "));
}

// Adds a row, unless all runs say the same.
void add_row(Table& table, const Texts& begin, const Texts& values) {
  if (std::ranges::all_of(values, [&](const auto& value) { return value == values[0]; })) return;
  auto& row = table.rows.emplace_back();
  for (const auto& text : begin) row.emplace_back(text);
  for (const auto& text : values) row.push_back(unquote_number(text));
}

Table start(Texts columns, const std::vector<ComparedRun>& runs) {
  Table table{.columns = std::move(columns), .axes = 1, .rows = {}};
  for (const auto& run : runs) table.columns.push_back(run.name);
  return table;
}

// What a run's models say of each entry, with its unit.
std::map<std::string, std::pair<std::string, std::string>> find_entries(const ComparedRun& run,
                                                                        bool with_model) {
  std::map<std::string, std::pair<std::string, std::string>> entries;
  for (const auto& model : run.record.at("models"))
    for (const auto& [key, entry] : model.at("entries").items()) {
      const auto name = model.at("name").get<std::string>();
      entries[with_model ? fmt::format("{}: {}", name, key) : key] = {
          to_string(to_cell(entry.at("value").get<double>())), entry.at("unit").get<std::string>()};
    }
  return entries;
}

}  // namespace

std::vector<ComparedRun> load_runs(const Texts& folders) {
  base::require(folders.size() >= 2, "compare", "found {} folder, expected two or more",
                folders.size());
  for (std::size_t i = 0; i < folders.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      base::require(parts_of(folders[i]) != parts_of(folders[k]), "compare",
                    "found {} twice, expected different results", folders[i]);
  const auto names = find_names(folders);
  std::vector<ComparedRun> runs;
  for (std::size_t i = 0; i < folders.size(); ++i) runs.push_back(load_run(folders[i], names[i]));
  return runs;
}

std::vector<NamedTable> tables_of(const std::vector<ComparedRun>& runs) {
  std::vector<NamedTable> tables;
  for (const auto& run : runs) tables.push_back({run.name, run.simulation.table});
  return tables;
}

Table differing_settings(const std::vector<ComparedRun>& runs) {
  Table table = start({"setting"}, runs);
  const auto each = [&](auto find) {
    Texts values;
    for (const auto& run : runs) values.push_back(find(run));
    return values;
  };
  add_row(table, {"tlab"},
          each([](const ComparedRun& run) { return run.record.value("tlab", "unknown"); }));
  Texts keys;
  for (const auto& run : runs) {
    const auto& file = run.simulation.file;
    for (const auto& key : file.axis_keys) keys.push_back(key);
    for (const auto& [key, _] : file.settings) keys.push_back(key);
  }
  std::ranges::sort(keys);
  keys.erase(std::ranges::unique(keys).begin(), keys.end());
  for (const auto& key : keys)
    add_row(table, {key},
            each([&](const ComparedRun& run) { return value_of(run.simulation.file, key); }));
  Texts inputs;
  for (const auto& run : runs)
    for (const auto& [path, _] : run.record.at("inputs").items())
      if (std::ranges::find(inputs, path) == inputs.end()) inputs.push_back(path);
  for (const auto& path : inputs)
    add_row(table, {"content of " + path}, each([&](const ComparedRun& run) {
              return run.record.at("inputs").value(path, "not read");
            }));
  return table;
}

Table differing_entries(const std::vector<ComparedRun>& runs) {
  Table table = start({"entry", "unit"}, runs);
  const bool with_model = std::ranges::any_of(
      runs, [](const ComparedRun& run) { return run.record.at("models").size() > 1; });
  std::vector<std::map<std::string, std::pair<std::string, std::string>>> entries;
  for (const auto& run : runs) entries.push_back(find_entries(run, with_model));
  std::map<std::string, std::string> units;
  for (const auto& of_run : entries)
    for (const auto& [key, entry] : of_run) units[key] = entry.second;
  for (const auto& [key, unit] : units) {
    Texts values;
    for (const auto& of_run : entries) {
      const auto entry = of_run.find(key);
      values.push_back(entry == of_run.end() ? "none" : entry->second.first);
    }
    add_row(table, {key, unit}, values);
  }
  return table;
}

}  // namespace laboratory

#include "experiments/laboratory/compare/runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "base/errors.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/points/origin.hpp"
#include "experiments/laboratory/points/results.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;

using Texts = std::vector<std::string>;

// shown for a setting that the file does not set and whose default is unknown
constexpr const char* BY_DEFAULT = "by default";

// The components of a path, without "." and without a trailing separator.
Texts parts_of(const std::string& folder) {
  Texts parts;
  for (const auto& part : fs::absolute(folder).lexically_normal())
    if (!part.empty()) parts.push_back(part.string());
  return parts;
}

// The last `count` components of a path.
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

std::vector<RecordedModel> read_models(const nlohmann::ordered_json& json) {
  std::vector<RecordedModel> models;
  for (const auto& of_model : json) {
    auto& model = models.emplace_back();
    model.name = of_model.at("name").get<std::string>();
    for (const auto& [key, entry] : of_model.at("entries").items())
      model.entries[key] = {entry.at("value").get<double>(), entry.at("unit").get<std::string>()};
  }
  return models;
}

ComparedRun load_run(const std::string& folder, const std::string& name) {
  const auto file = fs::path(folder) / "run.json";
  const Origin origin = load_origin(folder, "run.json");
  try {
    const auto json = nlohmann::ordered_json::parse(base::read_own_text(file));
    return {.folder = folder,
            .name = name,
            .command = command_line(origin.options),
            .version = json.at("tlab").get<std::string>(),
            .simulation = load_simulation(folder, origin.file),
            .models = read_models(json.at("models")),
            .inputs = json.at("inputs").get<std::map<std::string, std::string>>()};
  } catch (const nlohmann::json::exception& error) {
    throw make_damaged(file, error);
  } catch (const base::BadInput& error) {
    throw base::BadInput(fmt::format("{}: {}", folder, error.what()));
  }
}

// Removes the quotes of a TOML string.
std::string unquote(const std::string& text) {
  const bool is_quoted = text.size() > 1 && text.front() == text.back() &&
                         (text.front() == '"' || text.front() == '\'');
  return is_quoted ? text.substr(1, text.size() - 2) : text;
}

// The default value of a key that the file does not set.
std::string default_of(const ExperimentFile& file, const std::string& key) {
  const Experiment& e = file.points[0].experiment;
  if (key == "program.name") return e.program->name;
  if (key == "machine.model") return e.model.source.text;
  if (key == "network.topology") return e.topology.text;
  if (key == "network.workers") return std::to_string(e.workers);
  for (const auto& p : e.program->parameters)
    if (programs::key_of(p) == key) return base::to_text(p.get(e.params));
  return BY_DEFAULT;
}

std::string value_of(const ExperimentFile& file, const std::string& key) {
  if (const auto given = file.keys.find(key); given != file.keys.end())
    return unquote(base::to_toml(*given->second));
  Texts values;
  for (const auto& point : file.points)
    for (const auto& at : point.at)
      if (const auto value = unquote(base::to_toml(*at.value));
          at.key == key && std::ranges::find(values, value) == values.end())
        values.push_back(value);
  return values.empty() ? default_of(file, key) : fmt::format("[{}]", join_texts(values, ", "));
}

// Adds a row for a setting if its values differ between the runs.
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

// The names of a run's machine models.
Texts names_of(const ComparedRun& run) {
  Texts names;
  for (const auto& model : run.models) names.push_back(model.name);
  return names;
}

Texts find_shared_models(const std::vector<ComparedRun>& runs) {
  Texts shared = names_of(runs[0]);
  for (const auto& run : runs)
    std::erase_if(shared, [names = names_of(run)](const auto& name) {
      return std::ranges::find(names, name) == names.end();
    });
  return shared;
}

// Adds a row for each entry whose value differs between the models. There is one model for each
// run.
void add_entries(Table& table, const std::string& prefix,
                 const std::vector<const RecordedModel*>& models) {
  std::map<std::string, std::string> units;
  for (const auto* model : models)
    for (const auto& [key, entry] : model->entries) units[key] = entry.unit;
  for (const auto& [key, unit] : units) {
    Texts values;
    for (const auto* model : models) {
      const auto entry = model->entries.find(key);
      values.push_back(entry == model->entries.end() ? "none"
                                                     : to_string(to_cell(entry->second.value)));
    }
    add_row(table, {prefix + key, unit}, values);
  }
}

// Makes the named column the first axis of the table. If the table lacks this column, inserts it
// with `value` in every row.
void add_axis(Table& table, const std::string& axis, const std::string& value) {
  const auto column = table.find(axis);
  const auto move = [&](auto& cells, auto otherwise) {
    if (column) {
      otherwise = std::move(cells[*column]);
      cells.erase(cells.begin() + static_cast<std::ptrdiff_t>(*column));
    }
    cells.insert(cells.begin(), std::move(otherwise));
  };
  for (auto& row : table.rows) move(row, unquote_number(value));
  move(table.columns, axis);
  ++table.axes;
}

}  // namespace

std::vector<ComparedRun> load_runs(const Texts& folders) {
  base::require(folders.size() >= 2, "compare", "found {} folder, expected two or more",
                folders.size());
  for (std::size_t i = 0; i < folders.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      std::error_code ignored;
      base::require(!fs::equivalent(folders[i], folders[k], ignored), "compare",
                    "found {} twice, expected different folders", folders[i]);
    }
  const auto names = find_names(folders);
  std::vector<ComparedRun> runs;
  for (std::size_t i = 0; i < folders.size(); ++i) runs.push_back(load_run(folders[i], names[i]));
  return runs;
}

std::vector<NamedTable> make_tables(const std::vector<ComparedRun>& runs) {
  std::vector<NamedTable> tables;
  for (const auto& run : runs) {
    const Table& all = run.simulation.table;
    Table table{.columns = all.columns, .axes = all.axes, .rows = {}};
    std::ranges::copy_if(all.rows, std::back_inserter(table.rows),
                         [&](const auto& row) { return is_complete_row(all, row); });
    for (const auto& other : runs) {
      const auto& file = other.simulation.file;
      for (const auto& [axis, key, values] : file.axes()) {
        const auto column = table.find(axis);
        const bool is_there = column ? *column < table.axes : !other.simulation.table.find(axis);
        const auto value = value_of(run.simulation.file, key);
        if (!is_there && (column || value != BY_DEFAULT)) add_axis(table, axis, value);
      }
    }
    tables.push_back({run.name, std::move(table)});
  }
  return tables;
}

Table find_differing_settings(const std::vector<ComparedRun>& runs) {
  Table table = start({"setting"}, runs);
  const auto add = [&](const std::string& name, auto value) {
    Texts values;
    for (const auto& run : runs) values.push_back(value(run));
    add_row(table, {name}, values);
  };
  add("tlab", [](const ComparedRun& run) { return run.version; });
  std::set<std::string> keys{"program.name"}, paths;
  for (const auto& run : runs) {
    const auto& file = run.simulation.file;
    for (const auto& axis : file.axes()) keys.insert(axis.key);
    for (const auto& [key, value] : spell_keys(file.keys)) keys.insert(key);
    for (const auto& [path, hash] : run.inputs) paths.insert(path);
  }
  for (const auto& key : keys)
    add(key, [&](const ComparedRun& run) { return value_of(run.simulation.file, key); });
  for (const auto& path : paths)
    add("content of " + path, [&](const ComparedRun& run) {
      const auto input = run.inputs.find(path);
      return input == run.inputs.end() ? "not read" : input->second;
    });
  return table;
}

Table find_differing_entries(const std::vector<ComparedRun>& runs) {
  Table table = start({"entry", "unit"}, runs);
  const auto take = [&](auto choose) {
    std::vector<const RecordedModel*> models;
    for (const auto& run : runs) models.push_back(&*choose(run.models));
    return models;
  };
  if (std::ranges::all_of(runs, [](const ComparedRun& run) { return run.models.size() == 1; })) {
    add_entries(table, "", take([](const auto& models) { return models.begin(); }));
    return table;
  }
  Texts names;
  for (const auto& run : runs) names.push_back(join_texts(names_of(run), ", "));
  add_row(table, {"models", ""}, names);
  for (const auto& name : find_shared_models(runs))
    add_entries(table, name + ": ", take([&](const auto& models) {
                  return std::ranges::find(models, name, &RecordedModel::name);
                }));
  return table;
}

}  // namespace laboratory

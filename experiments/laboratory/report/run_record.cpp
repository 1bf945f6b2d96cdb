#include "experiments/laboratory/report/run_record.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "experiments/laboratory/host/files.hpp"
#include "experiments/laboratory/host/hash.hpp"
#include "experiments/laboratory/points/machine_model.hpp"
#include "experiments/laboratory/points/origin.hpp"
#include "experiments/laboratory/points/point_store.hpp"
#include "experiments/laboratory/points/results.hpp"
#include "simulator/machine/engine.hpp"

namespace laboratory {

namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

ordered_json model_json(const machine::Model& model) {
  ordered_json entries;
  for (const auto& e : model.entries)
    entries[e.key] = {{"value", e.value},
                      {"unit", e.unit},
                      {"provenance", machine::to_string(e.provenance)},
                      {"source", e.source}};
  ordered_json calibrated = ordered_json::array();
  for (const auto& e : model.entries)
    if (e.provenance == machine::Provenance::calibrated) calibrated.push_back(e.key);
  return {{"name", model.name}, {"calibrated", calibrated}, {"entries", entries}};
}

ordered_json models_json(const ExperimentFile& file) {
  ordered_json models = ordered_json::array();
  for (const auto& model : models_of(file)) models.push_back(model_json(model));
  return models;
}

// Scenes, networks and routes that are files.
ordered_json inputs_json(const ExperimentFile& file) {
  std::set<std::string> paths;
  const auto add = [&](const std::string& source) {
    if (fs::is_regular_file(source)) paths.insert(source);
  };
  for (const auto& point : file.points) {
    const Experiment& e = point.experiment;
    for (const auto& source : {e.scene, e.topology, e.routes}) add(source);
    for (const auto& [name, named] : e.files) add(named.path);
  }
  ordered_json inputs = ordered_json::object();
  for (const auto& path : paths) inputs[path] = hash_of(read_file(path));
  return inputs;
}

ordered_json speeds_json(const HostSpeeds& speeds) {
  ordered_json all = ordered_json::object();
  for (const auto& [model, speed] : speeds)
    all[model] = {{"cycles_per_host_s", speed.cycles_per_host_s},
                  {"spread", speed.spread},
                  {"repeats", speed.repeats}};
  return all;
}

ordered_json point_json(const fs::path& folder, const Simulation& s, std::size_t i) {
  ordered_json at = ordered_json::object();
  const auto& row = s.table.rows[s.table.row_of(i)];
  const auto axes = axis_columns(s.file);
  for (std::size_t c = 0; c < axes.size(); ++c) at[axes[c]] = to_string(row[c]);
  ordered_json point = {{"at", at}, {"record", s.records[i].string()}};
  if (!s.images[i].empty()) point["image"] = s.images[i];
  if (is_farm(s.file)) point["seed"] = s.file.points[i].experiment.farm.seed;
  for (const char* key : {"topology", "key_images", "images", "host", "ended", "message", "notes"})
    if (s.results[i].contains(key)) point[key] = s.results[i][key];
  auto record = load_record(folder / s.records[i]);
  if (record.contains("use")) point["use"] = std::move(record["use"]);
  return point;
}

}  // namespace

void save_run_json(const fs::path& folder, const RunOptions& options, const Simulation& s) {
  ordered_json run = make_origin(options, s.file, results_folder(options));
  run["simgrid"] = machine::simgrid_version();
  run["command"] = command_line(options);
  run["models"] = models_json(s.file);
  run["inputs"] = inputs_json(s.file);
  run["ended"] = s.ended;
  run["complete"] = s.complete;
  run["host_wall_s"] = s.wall_s;
  run["jobs"] = options.jobs;
  if (!s.host_speeds.empty()) run["host_speed"] = speeds_json(s.host_speeds);
  auto text = run.dump(2);
  text.resize(text.size() - 2);  // the end, "\n}"
  write_file(folder / "run.json", [&](const Sink& put) {
    put(text);
    put(",\n  \"points\": [");
    for (std::size_t i = 0; i < s.results.size(); ++i)
      put((i > 0 ? ",\n    " : "\n    ") + point_json(folder, s, i).dump());
    put("\n  ]\n}\n");
  });
}

}  // namespace laboratory

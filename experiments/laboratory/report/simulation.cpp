#include "experiments/laboratory/report/simulation.hpp"

#include <map>
#include <ostream>

#include "base/errors.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/host/hash.hpp"
#include "experiments/laboratory/judge/cover.hpp"
#include "experiments/laboratory/points/dictionary.hpp"
#include "experiments/laboratory/points/origin.hpp"
#include "experiments/laboratory/points/point_store.hpp"
#include "experiments/laboratory/points/results.hpp"
#include "experiments/laboratory/setup/setup.hpp"
#include "simulator/machine/engine.hpp"

namespace laboratory {
namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

ordered_json models_json(const ExperimentFile& file) {
  ordered_json models = ordered_json::array();
  for (const auto& model : models_of(file)) {
    ordered_json entries, calibrated = ordered_json::array();
    for (const auto& e : model.entries) {
      entries[e.key] = {{"value", e.value},
                        {"unit", e.unit},
                        {"provenance", machine::to_string(e.provenance)},
                        {"source", e.source}};
      if (e.provenance == machine::Provenance::calibrated) calibrated.push_back(e.key);
    }
    models.push_back({{"name", model.name}, {"calibrated", calibrated}, {"entries", entries}});
  }
  return models;
}

// Hashes each file that the experiment reads, such as scenes, networks and routes.
ordered_json inputs_json(const ExperimentFile& file) {
  std::map<std::string, std::string> hashes;
  for (const auto& point : file.points)
    for (const auto& path : files_of(point.experiment))
      if (fs::is_regular_file(path) && !hashes.contains(path))
        hashes[path] = hash_of(base::read_text(path));
  return hashes;
}

ordered_json speeds_json(const HostSpeeds& speeds) {
  ordered_json all = ordered_json::object();
  for (const auto& [model, speed] : speeds) {
    ordered_json workloads;
    for (const auto& of : speed.workloads)
      workloads[of.name] = {{"cycles_per_host_s", of.cycles_per_host_s}, {"spread", of.spread}};
    all[model] = {{"cycles_per_host_s", speed.cycles_per_host_s},
                  {"spread", speed.spread},
                  {"repeats", speed.repeats},
                  {"workloads", workloads},
                  {"clock_interval_s", speed.clock_interval_s}};
  }
  return all;
}

ordered_json point_json(const fs::path& folder, const Simulation& s, std::size_t i) {
  ordered_json at = ordered_json::object();
  const auto& row = s.table.rows[s.table.row_of(i)];
  const auto axes = axis_columns(s.file);
  for (std::size_t c = 0; c < axes.size(); ++c) at[axes[c]] = to_json(row[c]);
  ordered_json point = {{"at", at}, {"record", s.records[i].string()}};
  auto record = to_json(load_record(folder / s.records[i]));
  for (const char* key : {"topology", "host", "ended", "message", "notes", "use", "kernels"})
    if (record.contains(key) && !record[key].empty()) point[key] = std::move(record[key]);
  if (const auto& single_s = s.results[i].single_s) point["single_worker_s"] = *single_s;
  for (const auto& image : s.results[i].images) {
    ordered_json placed = {{"path", image.path}, {"caption", image.caption}};
    if (image.at_s) placed["at_s"] = *image.at_s;
    if (!image.exr.empty()) placed["exr"] = image.exr;
    point["images"].push_back(placed);
  }
  return point;
}

// Reads the images of a point from run.json. Throws if an image is there, but is no file.
std::vector<SavedImage> read_images(const ordered_json& point, const fs::path& folder) {
  std::vector<SavedImage> images;
  for (const auto& json : point.value("images", ordered_json::array())) {
    auto& image = images.emplace_back();
    image.path = json.at("path").get<std::string>();
    const auto file = folder / image.path;
    base::require(!fs::exists(file) || fs::is_regular_file(file), file.string(),
                  "found a pipe, a device or a folder, expected a picture");
    image.caption = json.at("caption").get<std::string>();
    image.exr = json.value("exr", "");
    if (json.contains("at_s")) image.at_s = json["at_s"].get<double>();
  }
  return images;
}

}  // namespace

Simulation load_simulation(const fs::path& folder, const ExperimentFile& file) {
  const auto run = ordered_json::parse(base::read_own_text(folder / "run.json"));
  Simulation s;
  s.file = file;
  s.file.points.clear();
  std::map<std::string, const laboratory::Point*> points;
  for (const auto& point : file.points) points[name_of(point)] = &point;
  for (const auto& json : run.at("points")) {
    s.records.push_back(json.at("record").get<std::string>());
    auto result = load_record(folder / s.records.back());
    result.use = nullptr;
    result.images = read_images(json, folder);
    if (json.contains("single_worker_s")) result.single_s = json["single_worker_s"].get<double>();
    const auto point = points.find(result.at);
    base::require(point != points.end(), s.records.back().string(),
                  "damaged: found a record of the point \"{}\", expected one of the experiment",
                  result.at);
    s.file.points.push_back(*point->second);
    s.results.push_back(std::move(result));
  }
  base::require(!s.results.empty(), "run.json", "damaged: found no points, expected some");
  const auto plan = plan_checks(s.file);
  s.table = make_table(plan, s.file, s.results);
  s.checks = eval_checks(plan, s.file, s.table);
  if (const auto confidence = load_confidence(folder)) check_cover(s.checks, s.table, *confidence);
  s.ended = run.at("ended").get<std::string>();
  s.complete = run.at("complete").get<bool>();
  return s;
}

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
  run["threads"] = options.threads;
  if (!s.host_speeds.empty()) run["host_speed"] = speeds_json(s.host_speeds);
  auto text = run.dump(2);
  text.resize(text.size() - 2);  // removes "\n}" at the end of the JSON text
  base::save_whole(folder / "run.json", [&](std::ostream& out) {
    out << text << ",\n  \"points\": [";
    // stops at the first write error, so that errno still describes this error
    for (std::size_t i = 0; i < s.results.size() && out; ++i)
      out << (i > 0 ? ",\n    " : "\n    ") << point_json(folder, s, i).dump();
    out << "\n  ]\n}\n";
  });
}

}  // namespace laboratory

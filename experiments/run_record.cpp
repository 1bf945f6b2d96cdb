#include "experiments/run_record.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "experiments/files.hpp"
#include "experiments/machine_model.hpp"
#include "experiments/results.hpp"
#include "experiments/values.hpp"
#include "experiments/version.hpp"
#include "simulator/machine/engine.hpp"

namespace experiments {

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

// FNV-1a
std::string hash_of(const std::string& bytes) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return fmt::format("{:016x}", hash);
}

// Scenes and networks that are files.
ordered_json inputs_json(const ExperimentFile& file) {
  std::set<std::string> paths;
  for (const auto& point : file.points)
    for (const auto& source : {point.experiment.scene, point.experiment.topology})
      if (fs::is_regular_file(source)) paths.insert(source);
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

ordered_json points_json(const Simulation& s) {
  const ExperimentFile& file = s.file;
  ordered_json points = ordered_json::array();
  for (std::size_t i = 0; i < s.results.size(); ++i) {
    ordered_json at = ordered_json::object();
    for (std::size_t c = 0; c < s.table.axes; ++c)
      at[s.table.columns[c]] = to_string(s.table.rows[i][c]);
    ordered_json point = {{"at", at}};
    if (is_farm(file)) point["seed"] = file.points[i].experiment.farm.seed;
    for (const auto& [key, value] : s.results[i].items())
      if (key == "topology" || key == "key_images" || key == "use" || key == "host" ||
          key == "ended")
        point[key] = value;
    points.push_back(std::move(point));
  }
  return points;
}

// Checks and figures say nothing about what happens.
std::string without_checks(const std::string& resolved) {
  try {
    auto file = toml::parse(resolved);
    for (const char* section : {"check", "let", "plot", "best", "report"}) file.erase(section);
    return to_toml(file);
  } catch (const toml::parse_error&) {
    return resolved;  // of a damaged record: equal to nothing
  }
}

}  // namespace

std::string command_line(const RunOptions& options) {
  std::string line = "tlab run " + options.file;
  for (const auto& set : options.overrides) line += fmt::format(" --set '{}'", set);
  if (std::isfinite(options.until_s)) line += fmt::format(" --until {}", options.until_s);
  return line;
}

std::string make_run_json(const RunOptions& options, const Simulation& simulation) {
  const ExperimentFile& file = simulation.file;
  ordered_json run = {{"tlab", VERSION},
                      {"simgrid", machine::simgrid_version()},
                      {"command", command_line(options)},
                      {"experiment", file.resolved},
                      {"models", models_json(file)},
                      {"inputs", inputs_json(file)},
                      {"ended", simulation.ended},
                      {"complete", simulation.complete},
                      {"points", points_json(simulation)},
                      {"host_wall_s", simulation.wall_s},
                      {"jobs", options.jobs}};
  if (!simulation.host_speeds.empty()) run["host_speed"] = speeds_json(simulation.host_speeds);
  return run.dump(2) + "\n";
}

std::optional<Table> find_results(const fs::path& folder, const ExperimentFile& file) {
  std::error_code error;
  const auto record = folder / "run.json", results = folder / "results.csv";
  if (!fs::is_regular_file(record, error) || !fs::is_regular_file(results, error)) return {};
  const auto built = fs::last_write_time("/proc/self/exe", error);
  if (error || fs::last_write_time(record) < built) return {};
  const auto run = ordered_json::parse(read_file(record), nullptr, false);
  auto same = [&](const char* key, const ordered_json& expected) {
    return run.contains(key) && run[key] == expected;
  };
  if (!run.is_object() || !same("tlab", VERSION) || !same("complete", true) ||
      !same("models", models_json(file)) || !same("inputs", inputs_json(file)) ||
      !run.contains("experiment") || !run["experiment"].is_string())
    return {};
  if (without_checks(run["experiment"].get<std::string>()) != without_checks(file.resolved))
    return {};
  Table table;
  try {
    table = parse_csv(read_file(results), results.string());
  } catch (const std::invalid_argument&) {
    return {};  // damaged: run again
  }
  const auto axes = axis_columns(file);
  table.axes = axes.size();
  if (table.rows.size() != file.points.size() || table.columns.size() < axes.size() ||
      !std::ranges::equal(axes, table.columns | std::views::take(axes.size())))
    return {};
  return table;
}

}  // namespace experiments

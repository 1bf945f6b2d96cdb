#include "experiments/run_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/files.hpp"
#include "experiments/plot.hpp"
#include "experiments/report.hpp"
#include "experiments/results.hpp"
#include "experiments/version.hpp"
#include "simulator/machine/engine.hpp"
#include "simulator/machine/model.hpp"

namespace experiments {

namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

std::string command_line(const RunOptions& options) {
  std::string line = "tlab run " + options.file;
  for (const auto& set : options.overrides) line += fmt::format(" --set '{}'", set);
  return line;
}

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

// Every model that some point ran on.
std::vector<machine::Model> models_of(const ExperimentFile& file) {
  std::vector<std::string> names;
  std::vector<machine::Model> models;
  for (const auto& point : file.points)
    if (std::ranges::find(names, point.experiment.model) == names.end()) {
      names.push_back(point.experiment.model);
      models.push_back(machine::load_model(names.back()));
    }
  return models;
}

std::vector<Report::ModelRow> model_rows(const std::vector<machine::Model>& models) {
  std::vector<Report::ModelRow> rows;
  for (const auto& model : models)
    for (const auto& e : model.entries)
      rows.push_back({models.size() > 1 ? model.name + ": " + e.key : e.key,
                      machine::to_text(e.value), e.unit,
                      std::string(machine::to_string(e.provenance)), e.source});
  return rows;
}

// The values an axis takes, or the one value of a key that is not swept.
std::string values_of(const ExperimentFile& file, const char* axis, const std::string& value) {
  std::vector<std::string> values;
  for (const auto& point : file.points)
    for (const auto& at : point.at)
      if (at.axis == axis && std::ranges::find(values, at.toml) == values.end())
        values.push_back(at.toml);
  return values.empty() ? value : fmt::format("{}", fmt::join(values, ", "));
}

std::vector<std::pair<std::string, std::string>> make_facts(const ExperimentFile& file) {
  const Experiment& e = file.points[0].experiment;
  const auto& p = e.farm.image;
  auto swept = [&](const char* axis, const std::string& value) {
    return values_of(file, axis, value);
  };
  return {
      {"Machine", fmt::format("{} processors, coordinator, ray database and display on one each",
                              swept("model", e.model))},
      {"Workers", fmt::format("{} on topology {}", swept("workers", fmt::format("{}", e.workers)),
                              swept("topology", e.topology))},
      {"Scene", fmt::format("{}, objects: {}", swept("source", e.scene),
                            swept("objects", fmt::format("{}", e.objects)))},
      {"Image", fmt::format("{} x {} pixels, tree depth {}, minimum influence {}", p.width,
                            p.height, p.limits.depth, p.limits.min_influence)},
      {"Task", "one ray"},
      {"Points", fmt::format("{}", file.points.size())}};
}

}  // namespace

std::vector<std::string> shown_columns(const Table& table) {
  std::vector<std::string> shown(table.columns.begin(),
                                 table.columns.begin() + static_cast<std::ptrdiff_t>(table.axes));
  for (const char* name :
       {"rays", "time_s", "time_per_ray_ms", "speedup", "efficiency", "cpu_busy_worker_mean",
        "cpu_busy_coordinator", "cpu_busy_database", "link_busy_max"})
    if (table.find(name)) shown.push_back(name);
  return shown;
}

std::string make_run_json(const RunOptions& options, const ExperimentFile& file, const Table& table,
                          const std::vector<ordered_json>& results, double wall_s) {
  ordered_json points = ordered_json::array(), models = ordered_json::array();
  for (std::size_t i = 0; i < results.size(); ++i) {
    ordered_json at;
    for (std::size_t c = 0; c < table.axes; ++c) at[table.columns[c]] = to_string(table.rows[i][c]);
    points.push_back({{"at", at},
                      {"topology", results[i]["topology"]},
                      {"seed", file.points[i].experiment.farm.seed},
                      {"key_images", results[i]["key_images"]},
                      {"use", results[i]["use"]},
                      {"host", results[i]["host"]}});
  }
  for (const auto& model : models_of(file)) models.push_back(model_json(model));
  const ordered_json run = {{"tlab", VERSION},
                            {"simgrid", machine::simgrid_version()},
                            {"command", command_line(options)},
                            {"experiment", file.resolved},
                            {"models", models},
                            {"points", points},
                            {"host_wall_s", wall_s},
                            {"jobs", options.jobs}};
  return run.dump(2) + "\n";
}

void write_report(const fs::path& folder, const RunOptions& options, const ExperimentFile& file,
                  const Table& table, const std::vector<ordered_json>& results,
                  const std::vector<std::string>& images) {
  const Experiment& first = file.points[0].experiment;
  Report report;
  report.title = first.title.empty() ? fs::path(file.path).stem().string() : first.title;
  report.question = first.question;
  report.table = table;
  report.shown_columns = shown_columns(table);
  report.facts = make_facts(file);
  report.plots = make_plots(table);
  report.plots_folder = folder / "plots";
  if (!report.plots.empty()) fs::create_directory(report.plots_folder);
  for (const auto& plot : report.plots) draw_plot(plot, report.plots_folder);
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (images[i].empty()) continue;
    for (const auto& key : results[i]["key_images"]) {
      const auto name = key["path"].get<std::string>();
      report.images.push_back({fmt::format("{}, after {:.2f} s", name.substr(6, name.size() - 10),
                                           key["at_s"].get<double>()),
                               folder / name});
    }
    report.images.push_back({images[i].substr(6, images[i].rfind('.') - 6), folder / images[i]});
  }
  report.experiment_toml = file.resolved;
  report.command = command_line(options);
  report.model = model_rows(models_of(file));
  write_file(folder / "report.html", make_report(report));
}

}  // namespace experiments

#include "experiments/run_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/farm_run.hpp"
#include "experiments/files.hpp"
#include "experiments/machine_model.hpp"
#include "experiments/pattern_table.hpp"
#include "experiments/plot.hpp"
#include "experiments/program.hpp"
#include "experiments/report.hpp"
#include "experiments/results.hpp"
#include "experiments/run_record.hpp"

namespace experiments {

namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

// The first model whole; of others what differs from it.
std::vector<Report::ModelRow> model_rows(const std::vector<machine::Model>& models) {
  std::vector<Report::ModelRow> rows;
  for (const auto& model : models)
    for (const auto& e : model.entries) {
      const auto& first = models[0].entries;
      const bool is_known = std::ranges::any_of(
          first, [&](const auto& f) { return f.key == e.key && f.value == e.value; });
      if (&model != &models[0] && is_known) continue;
      rows.push_back({models.size() > 1 ? model.name + ": " + e.key : e.key,
                      machine::to_text(e.value), e.unit,
                      std::string(machine::to_string(e.provenance)), e.source});
    }
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

using Facts = std::vector<std::pair<std::string, std::string>>;

Facts make_pattern_facts(const ExperimentFile& file) {
  const Experiment& e = file.points[0].experiment;
  const auto& pattern = *find_pattern(e.program);
  Facts facts{{"Program", fmt::format("{}: {}", pattern.name, pattern.help)},
              {"Machine", values_of(file, "model", e.model)}};
  if (pattern.uses_topology)
    facts.push_back(
        {"Network", fmt::format("{}, processors: {}", values_of(file, "topology", e.topology),
                                has_own_workers(e)
                                    ? "its own number"
                                    : values_of(file, "workers", fmt::format("{}", e.workers)))});
  for (const auto& p : pattern.parameters)
    facts.push_back({p.name, fmt::format("{} ({})",
                                         values_of(file, p.name.c_str(),
                                                   fmt::format("{}", e.parameters.at(p.name))),
                                         p.help)});
  facts.push_back({"Points", fmt::format("{}", file.points.size())});
  return facts;
}

Facts make_facts(const ExperimentFile& file) {
  if (!is_farm(file)) return make_pattern_facts(file);
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

constexpr std::size_t EVERY_POINT = std::size_t(-1);

}  // namespace

std::string title_of(const ExperimentFile& file) {
  const auto& title = file.points[0].experiment.title;
  return title.empty() ? fs::path(file.path).stem().string() : title;
}

std::vector<std::string> shown_columns(const ExperimentFile& file, const Table& table) {
  if (!is_farm(file)) return table.columns;
  std::vector<std::string> shown(table.columns.begin(),
                                 table.columns.begin() + static_cast<std::ptrdiff_t>(table.axes));
  for (const char* name :
       {"rays", "time_s", "time_per_ray_ms", "speedup", "efficiency", "cpu_busy_worker_mean",
        "cpu_busy_coordinator", "cpu_busy_database", "link_busy_max"})
    if (table.find(name)) shown.push_back(name);
  return shown;
}

void write_report(const fs::path& folder, const RunOptions& options, const Simulation& s) {
  const ExperimentFile& file = s.file;
  const auto& results = s.results;
  const auto& images = s.images;
  const Table& table = s.table;
  Report report;
  report.title = title_of(file);
  report.question = file.points[0].experiment.question;
  report.table = table;
  report.shown_columns = shown_columns(file, table);
  report.facts = make_facts(file);
  report.facts.push_back({"Ended", s.ended});
  report.plots = is_farm(file) ? make_plots(table) : make_plots(table, first_result(file, table));
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
  for (const auto& check : s.checks)
    report.checks.push_back(
        {summarize(check, table), make_check_table(check, table, EVERY_POINT), check.notes});
  report.experiment_toml = file.resolved;
  report.command = command_line(options);
  report.model = model_rows(models_of(file));
  write_file(folder / "report.html", make_report(report));
}

}  // namespace experiments

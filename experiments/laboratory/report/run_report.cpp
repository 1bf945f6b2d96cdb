#include "experiments/laboratory/report/run_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "experiments/laboratory/file/program.hpp"
#include "experiments/laboratory/host/files.hpp"
#include "experiments/laboratory/judge/best.hpp"
#include "experiments/laboratory/judge/check_plan.hpp"
#include "experiments/laboratory/points/farm_run.hpp"
#include "experiments/laboratory/points/machine_model.hpp"
#include "experiments/laboratory/points/pattern_table.hpp"
#include "experiments/laboratory/points/results.hpp"
#include "experiments/laboratory/report/exhibit.hpp"
#include "experiments/laboratory/report/network_drawings.hpp"
#include "experiments/laboratory/report/plot.hpp"
#include "experiments/laboratory/report/report.hpp"
#include "experiments/laboratory/report/run_record.hpp"

namespace laboratory {

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
      if (const auto text = to_string(to_value(at));
          at.axis == axis && std::ranges::find(values, text) == values.end())
        values.push_back(text);
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
    facts.push_back(
        {p.name,
         fmt::format("{} ({})", values_of(file, p.name.c_str(), describe_value(p, e)), p.help)});
  facts.push_back({"Points", fmt::format("{}", file.points.size())});
  return facts;
}

std::string describe_task(const std::optional<farm::Block>& block) {
  if (!block) return "one ray";
  return fmt::format("a block of {} x {} pixels", block->width, block->height);
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
      {"Image",
       fmt::format("{} x {} pixels, tree depth {}, minimum influence {}",
                   swept("width", fmt::format("{}", p.width)),
                   swept("height", fmt::format("{}", p.height)),
                   swept("depth", fmt::format("{}", p.limits.depth)), p.limits.min_influence)},
      {"Task", swept("task", describe_task(e.farm.block))},
      {"Points", fmt::format("{}", file.points.size())}};
}

constexpr std::size_t EVERY_POINT = std::size_t(-1);

}  // namespace

std::string title_of(const ExperimentFile& file) {
  const auto& title = file.points[0].experiment.title;
  return title.empty() ? fs::path(file.path).stem().string() : title;
}

namespace {

// The axes and those of the names that there are.
std::vector<std::string> choose_columns(const Table& table,
                                        std::initializer_list<const char*> names) {
  std::vector<std::string> shown(table.columns.begin(),
                                 table.columns.begin() + static_cast<std::ptrdiff_t>(table.axes));
  for (const char* name : names)
    if (table.find(name)) shown.push_back(name);
  return shown;
}

}  // namespace

std::vector<std::string> shown_columns(const ExperimentFile& file, const Table& table) {
  if (!is_farm(file)) return table.columns;
  return choose_columns(
      table, {"rays", "time_s", "time_per_ray_ms", "speedup", "efficiency", "cpu_busy_worker_mean",
              "cpu_busy_coordinator", "cpu_busy_database", "link_busy_max", "bottleneck"});
}

namespace {

// What was busy how much, of the farm.
std::vector<std::string> load_columns(const ExperimentFile& file, const Table& table) {
  if (!is_farm(file)) return {};
  return choose_columns(
      table, {"time_s", "mean_distance", "mean_depth", "messages", "message_bytes", "cpu_busiest",
              "cpu_busy_max", "link_busiest", "link_busy_max", "bottleneck", "busiest",
              "busiest_busy", "next_busiest", "next_busy"});
}

void add_images(Report& report, const fs::path& folder, const Simulation& s) {
  std::set<std::string> shown;
  for (std::size_t i = 0; i < s.images.size(); ++i) {
    for (const auto& image : s.results[i].value("images", ordered_json::array()))
      if (const auto name = image["path"].get<std::string>(); shown.insert(name).second)
        report.images.push_back({image["caption"].get<std::string>(), folder / name});
    const auto& image = s.images[i];
    for (const auto& key : s.results[i].value("key_images", nlohmann::ordered_json::array())) {
      const auto name = key["path"].get<std::string>();
      report.images.push_back({fmt::format("{}, after {:.2f} s", name.substr(6, name.size() - 10),
                                           key["at_s"].get<double>()),
                               folder / name});
    }
    if (image.empty()) continue;
    report.images.push_back({image.substr(6, image.rfind('.') - 6), folder / image});
  }
}

// Those that are not there yet: two plots may say the same.
void append(std::vector<std::string>& to, const std::vector<std::string>& from) {
  for (const auto& text : from)
    if (std::ranges::find(to, text) == to.end()) to.push_back(text);
}

// [[plot]] and [[best]], where some point came to its end.
void add_figures(Report& report, const fs::path& folder, const Simulation& s) {
  const auto plan = plan_checks(s.file);
  if (std::ranges::none_of(s.table.rows,
                           [&](const auto& row) { return is_complete_row(s.table, row); }))
    return;
  const Rows rows = make_rows(plan, s.file, s.table);
  append(report.notes, note_unknown_texts(plan, s.table));
  const auto exhibits = make_exhibits(plan, rows, report.notes);
  for (const auto& exhibit : exhibits) {
    report.plots.push_back(exhibit.plot);
    report.plot_parts.push_back(
        {"", {exhibit.differences, exhibit.fits, exhibit.optima}, exhibit.notes});
    append(report.findings, exhibit.findings);
  }
  const auto answers = find_best(plan, rows);
  for (const auto& answer : answers) {
    report.answers.push_back({answer.name, {answer.best, answer.pays}, answer.notes});
    append(report.findings, answer.findings);
  }
  const auto save = [&](const char* name, const Table& table) {
    if (!table.rows.empty()) write_file(folder / name, to_csv(table));
  };
  save("fits.csv", make_fits_csv(exhibits));
  save("best.csv", make_best_csv(answers));
  save("pays.csv", make_pays_csv(answers));
}

void add_plots(Report& report, const fs::path& folder, const Simulation& s) {
  add_figures(report, folder, s);
  if (s.file.plots.empty())
    report.plots =
        is_farm(s.file) ? make_plots(s.table) : make_plots(s.table, first_result(s.file, s.table));
  std::erase_if(report.plots, [](const Plot& plot) { return !has_points(plot); });
  report.plots_folder = folder / "plots";
  if (report.plots.empty()) return;
  fs::create_directory(report.plots_folder);
  draw_plots(report.plots, report.plots_folder);
}

}  // namespace

void write_report(const fs::path& folder, const RunOptions& options, const Simulation& s) {
  Report report;
  report.title = title_of(s.file);
  report.question = s.file.points[0].experiment.question;
  report.table = s.table;
  report.shown_columns = shown_columns(s.file, s.table);
  report.load_columns = load_columns(s.file, s.table);
  report.facts = make_facts(s.file);
  report.facts.push_back({"Ended", s.ended});
  add_plots(report, folder, s);
  append(report.notes, notes_of(s.file, s.results));
  add_images(report, folder, s);
  report.drawings = draw_networks(folder, s);
  for (const auto& check : s.checks) {
    const auto summary = summarize(check, s.table);
    report.checks.push_back({summary, make_check_table(check, s.table, EVERY_POINT), check.notes});
    report.findings.push_back(summary);
  }
  report.experiment_toml = s.file.resolved;
  report.command = command_line(options);
  report.model = model_rows(models_of(s.file));
  write_file(folder / "report.html", make_report(report));
}

}  // namespace laboratory

#include "experiments/laboratory/report/run_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/errors.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/host/carry.hpp"
#include "experiments/laboratory/host/results_folder.hpp"
#include "experiments/laboratory/judge/best.hpp"
#include "experiments/laboratory/judge/check_plan.hpp"
#include "experiments/laboratory/points/origin.hpp"
#include "experiments/laboratory/points/point_store.hpp"
#include "experiments/laboratory/points/results.hpp"
#include "experiments/laboratory/report/exhibit.hpp"
#include "experiments/laboratory/report/gnuplot.hpp"
#include "experiments/laboratory/report/network_drawings.hpp"
#include "experiments/laboratory/report/plot.hpp"
#include "experiments/laboratory/report/plot_script.hpp"
#include "experiments/laboratory/report/report.hpp"
#include "experiments/laboratory/setup/setup.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;

using Texts = std::vector<std::string>;
using Facts = std::vector<std::pair<std::string, std::string>>;

// ---- What is shown of a program ----

// Lists the values that an axis takes, or the one value of a key that is not swept.
std::string values_of(const ExperimentFile& file, const char* axis, const std::string& value) {
  Texts values;
  for (const auto& point : file.points)
    for (const auto& at : point.at)
      if (const auto text = to_string(to_value(at));
          at.axis == axis && std::ranges::find(values, text) == values.end())
        values.push_back(text);
  return values.empty() ? value : join_texts(values, ", ");
}

// Adds the parameters of the program: all, or only those that are axes or differ from their
// defaults.
void add_parameters(Facts& facts, const ExperimentFile& file) {
  const Experiment& e = file.points[0].experiment;
  for (const auto& p : e.program->parameters) {
    const auto axis = p.name.substr(p.name.rfind('.') + 1);
    const auto values = values_of(file, axis.c_str(), base::to_text(p.get(e.params)));
    if (e.program->shows_parameters || values != base::to_text(p.get(e.program->defaults)))
      facts.push_back({p.name, fmt::format("{} ({})", values, p.help)});
  }
}

Facts make_facts(const ExperimentFile& file) {
  const Experiment& e = file.points[0].experiment;
  Facts facts{{"Program",
               fmt::format("{}: {}", values_of(file, "program", e.program->name), e.program->help)},
              {"Machine", values_of(file, "model", e.model.text)}};
  if (e.program->uses.network)
    facts.push_back(
        {"Network", fmt::format("{}, {}: {}", values_of(file, "topology", e.topology.text),
                                e.program->processors,
                                has_own_workers(e)
                                    ? "its own number"
                                    : values_of(file, "workers", fmt::format("{}", e.workers)))});
  add_parameters(facts, file);
  return facts;
}

// Chooses the axes, and those of the names that are columns.
Texts choose_columns(const Table& table, std::initializer_list<const char*> names) {
  Texts chosen = axis_names(table);
  for (const char* name : names)
    if (table.find(name)) chosen.push_back(name);
  return chosen;
}

// Chooses the columns of a second table.
Texts load_columns(const ExperimentFile& file, const Table& table) {
  if (!is_farm(file)) return {};
  return choose_columns(
      table, {"time_s", "mean_distance", "mean_depth", "messages_sent", "bytes_sent", "cpu_busiest",
              "cpu_busy_max", "link_busiest", "link_busy_max", "bottleneck", "busiest",
              "busiest_busy", "next_busiest", "next_busy"});
}

// Makes the plots of an experiment that declares none.
std::vector<Plot> usual_plots(const ExperimentFile& file, const Table& table) {
  return is_farm(file) ? make_plots(table) : make_plots(table, first_result(file, table));
}

// ---- What a run adds to the page ----

// Lists all entries of the first model, and those of the others that differ from it.
std::vector<Report::ModelRow> model_rows(const std::vector<machine::Model>& models) {
  std::vector<Report::ModelRow> rows;
  for (const auto& model : models)
    for (const auto& e : model.entries) {
      const bool is_known = std::ranges::any_of(models[0].entries, [&](const auto& first) {
        return first.key == e.key && first.value == e.value;
      });
      if (&model != &models[0] && is_known) continue;
      rows.push_back({models.size() > 1 ? model.name + ": " + e.key : e.key,
                      machine::to_text(e.value), e.unit,
                      std::string(machine::to_string(e.provenance)), e.source});
    }
  return rows;
}

void add_images(Report& report, const fs::path& folder, const Simulation& s) {
  std::set<std::string> shown;
  for (const auto& result : s.results)
    for (const auto& image : result.images)
      if (shown.insert(image.path).second)
        report.images.push_back({image.caption, folder / image.path});
}

// Adds the texts that are not there yet, since two figures may say the same.
void append(Texts& to, const Texts& from) {
  for (const auto& text : from)
    if (std::ranges::find(to, text) == to.end()) to.push_back(text);
}

void save_unless_empty(const fs::path& file, const Table& table) {
  if (!table.rows.empty()) base::save_whole(file, to_csv(table));
}

// Adds the declared figures and the answers, where some point came to its end.
std::vector<Exhibit> add_figures(Report& report, const fs::path& folder, const Simulation& s) {
  const auto plan = plan_checks(s.file);
  if (std::ranges::none_of(s.table.rows,
                           [&](const auto& row) { return is_complete_row(s.table, row); }))
    return {};
  const Rows rows = make_rows(plan, s.file, s.table);
  append(report.notes, note_unknown_texts(plan, s.table));
  auto exhibits = make_exhibits(plan, rows, report.notes);
  for (const auto& exhibit : exhibits) append(report.findings, exhibit.findings);
  const auto answers = find_best(plan, rows);
  for (const auto& answer : answers) {
    report.answers.push_back({answer.name, answer.notes, {answer.best, answer.pays}});
    append(report.findings, answer.findings);
  }
  save_unless_empty(folder / "fits.csv", make_fits_csv(exhibits));
  save_unless_empty(folder / "best.csv", make_best_csv(answers));
  save_unless_empty(folder / "pays.csv", make_pays_csv(answers));
  return exhibits;
}

// Draws the plots of these exhibits into `folder`, as far as they have points.
void add_plots(Report& report, const fs::path& folder, const std::vector<Exhibit>& exhibits) {
  std::vector<Plot> plots;
  for (const auto& exhibit : exhibits)
    if (has_points(exhibit.plot)) plots.push_back(exhibit.plot);
  if (plots.empty()) return;
  fs::create_directory(folder);
  draw_plots(plots, folder);
  for (const auto& e : exhibits)
    if (has_points(e.plot))
      report.plots.push_back(
          {fmt::format("{}: {} over {}", e.plot.title, e.plot.y_label, e.plot.x_label),
           base::read_text(folder / (e.plot.name + ".svg")),
           {"", e.notes, {e.differences, e.fits, e.optima}}});
}

void add_checks(Report& report, const Simulation& s) {
  constexpr auto EVERY_POINT = std::size_t(-1);
  for (const auto& check : s.checks) {
    const auto summary = summarize(check, s.table);
    report.checks.push_back(
        {summary, check.notes, {make_check_table(check, s.table, EVERY_POINT)}});
    report.findings.push_back(summary);
  }
}

}  // namespace

std::string title_of(const ExperimentFile& file) {
  const auto& title = file.points[0].experiment.title;
  return title.empty() ? fs::path(file.path).stem().string() : title;
}

std::vector<std::string> shown_columns(const ExperimentFile& file, const Table& table) {
  if (!is_farm(file)) return table.columns;
  return choose_columns(
      table, {"rays", "time_s", "time_per_ray_ms", "speedup", "efficiency", "cpu_busy_worker_mean",
              "cpu_busy_coordinator", "cpu_busy_database", "link_busy_max", "bottleneck"});
}

void write_report(const fs::path& folder, const RunOptions& options, const Simulation& s) {
  Report report;
  report.title = title_of(s.file);
  report.question = s.file.points[0].experiment.question;
  report.table = s.table;
  report.shown_columns = shown_columns(s.file, s.table);
  report.load_columns = load_columns(s.file, s.table);
  report.facts = make_facts(s.file);
  report.facts.push_back({"Points", fmt::format("{}", s.file.points.size())});
  report.facts.push_back({"Ended", s.ended});
  auto exhibits = add_figures(report, folder, s);
  if (s.file.plots.empty())
    for (const auto& plot : usual_plots(s.file, s.table)) exhibits.push_back({.plot = plot});
  add_plots(report, folder / "plots", exhibits);
  append(report.notes, notes_of(s.file, s.results));
  add_images(report, folder, s);
  report.networks = draw_networks(folder, s);
  add_checks(report, s);
  report.settings = s.file.resolved;
  report.command = command_line(options);
  report.model = model_rows(models_of(s.file));
  base::save_whole(folder / "report.html", make_report(report));
}

void report_results(const std::string& results) {
  const Origin origin = load_origin(results, "run.json");
  ResultsFolder folder(results);
  carry_files(results, folder.working());
  carry_files(results / fs::path("points"), folder.working() / "points");
  carry_records(results, folder.working());
  carry_files(results / lone_records_folder(), folder.working() / lone_records_folder());
  try {
    write_report(folder.working(), origin.options, load_simulation(folder.working(), origin.file));
  } catch (const nlohmann::json::exception& error) {
    throw base::BadInput(
        fmt::format("{}: damaged: {}", (fs::path(results) / "run.json").string(), error.what()));
  }
  folder.commit();
  fmt::print("report   {}\n", (fs::path(results) / "report.html").string());
}

}  // namespace laboratory

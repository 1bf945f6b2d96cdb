#include "experiments/laboratory/report/run_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <thread>

#include "base/errors.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/figure/pdf.hpp"
#include "experiments/laboratory/file/values.hpp"
#include "experiments/laboratory/host/error_text.hpp"
#include "experiments/laboratory/host/jobs.hpp"
#include "experiments/laboratory/host/link_files.hpp"
#include "experiments/laboratory/host/results_folder.hpp"
#include "experiments/laboratory/host/streams.hpp"
#include "experiments/laboratory/judge/best.hpp"
#include "experiments/laboratory/judge/check_plan.hpp"
#include "experiments/laboratory/judge/ranking.hpp"
#include "experiments/laboratory/plot/gnuplot.hpp"
#include "experiments/laboratory/plot/plot.hpp"
#include "experiments/laboratory/plot/plot_data.hpp"
#include "experiments/laboratory/plot/plot_script.hpp"
#include "experiments/laboratory/plot/si_prefix.hpp"
#include "experiments/laboratory/points/means.hpp"
#include "experiments/laboratory/points/origin.hpp"
#include "experiments/laboratory/points/point_store.hpp"
#include "experiments/laboratory/points/results.hpp"
#include "experiments/laboratory/points/view.hpp"
#include "experiments/laboratory/report/exhibit.hpp"
#include "experiments/laboratory/report/findings.hpp"
#include "experiments/laboratory/report/network_drawings.hpp"
#include "experiments/laboratory/report/report.hpp"
#include "experiments/laboratory/report/saturation.hpp"
#include "experiments/laboratory/setup/setup.hpp"
#include "experiments/laboratory/table/samples.hpp"
#include "experiments/laboratory/uncertain/confidence.hpp"
#include "experiments/laboratory/uncertain/tornado.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;

using Texts = std::vector<std::string>;
using Facts = std::vector<std::pair<std::string, std::string>>;

// Appends those texts that `to` does not contain yet.
void append(Texts& to, const Texts& from) {
  for (const auto& text : from)
    if (std::ranges::find(to, text) == to.end()) to.push_back(text);
}

// ---- Description of the program ----

// Lists the values of an axis; if it is no axis, returns `value`.
std::string values_of(const ExperimentFile& file, const char* axis, const std::string& value) {
  Texts values;
  for (const auto& point : file.points)
    for (const auto& at : point.at)
      if (const auto text = to_string(to_value(at));
          at.axis == axis && std::ranges::find(values, text) == values.end())
        values.push_back(text);
  return values.empty() ? value : join_texts(values, ", ");
}

// True if a parameter has no effect because of the value of another key.
bool is_void(const Experiment& e, const programs::Parameter& p) {
  return e.program->voids && !e.program->voids(e.params, programs::key_of(p)).empty();
}

// Adds the program's parameters that are not listed yet. If the program does not show its
// parameters, adds only axes and values that differ from the default.
void add_parameters(Facts& facts, const ExperimentFile& file) {
  const Experiment& e = file.points[0].experiment;
  for (const auto& p : e.program->parameters) {
    const auto axis = p.name.substr(p.name.rfind('.') + 1);
    const bool is_there = std::ranges::find(facts, axis, &Facts::value_type::first) != facts.end();
    if (is_there || is_void(e, p)) continue;
    const auto values = values_of(file, axis.c_str(), base::to_text(p.get(e.params)));
    if (e.program->shows_parameters || values != base::to_text(p.get(e.program->defaults)))
      facts.push_back({p.name, fmt::format("{} ({})", values, p.help)});
  }
}

// Lists the distinct values of a column.
std::string values_in(const Table& table, const std::string& column) {
  Texts values;
  if (const auto c = table.find(column))
    for (const auto& row : table.rows) append(values, {to_string(row[*c])});
  std::erase(values, "");
  return join_texts(values, ", ");
}

// Describes model, network and scene of the points, including default values.
Facts make_facts(const Simulation& s) {
  const ExperimentFile& file = s.file;
  const Experiment& e = file.points[0].experiment;
  Facts facts{{"Program",
               fmt::format("{}: {}", values_of(file, "program", e.program->name), e.program->help)},
              {"Machine", values_of(file, "model", e.model.source.text)}};
  for (const auto& [entry, value] : e.model.entries)
    facts.push_back(
        {"model." + entry, values_of(file, ("model." + entry).c_str(), machine::to_text(value))});
  for (const auto& other : e.others)
    facts.push_back({fmt::format("Processor number {}", other.number), other.model.source.text});
  if (e.program->uses.network) {
    facts.push_back(
        {"Network", fmt::format("{}, {}: {}", values_in(s.table, "topology"), e.program->processors,
                                values_in(s.table, e.program->processors))});
    if (e.switches > 0)
      facts.push_back(
          {"Switches on a link", values_of(file, "switches", std::to_string(e.switches))});
  }
  if (e.program->uses.timed)
    facts.push_back({"Cost", values_of(file, "cost", e.is_timed ? "timed" : "counted")});
  for (const auto& [name, cell] : s.results[0].described)
    facts.push_back({name, values_in(s.table, name)});
  add_parameters(facts, file);
  return facts;
}

// Formats a parameter's value as the experiment file spells it.
std::string spell(const programs::Parameter& p, const std::any& params) {
  const auto value = p.get(params);
  const auto text = base::to_text(value);
  if (p.domain.kind == base::Domain::Kind::flag) return text == "0" ? "false" : "true";
  const bool is_text = std::holds_alternative<std::string>(value) ||
                       (std::holds_alternative<base::Source>(value) && text != "none");
  if (std::holds_alternative<std::vector<double>>(value)) return "[" + text + "]";
  return is_text ? spell_text(text) : text;
}

// Formats the experiment as TOML, with default values as comments.
std::string make_settings(const ExperimentFile& file) {
  std::vector<std::string> lines;
  const auto add = [&](const std::string& key, const std::string& value) {
    const bool is_given =
        file.keys.contains(key) ||
        std::ranges::any_of(file.axes(), [&](const Axis& axis) { return axis.key == key; });
    if (!is_given) append(lines, {fmt::format("# {} = {}", key, value)});
  };
  std::set<const programs::Program*> known;
  for (const auto& point : file.points) {
    const Experiment& e = point.experiment;
    if (!known.insert(e.program).second) continue;
    add("machine.model", spell_text(e.model.source.text));
    if (e.program->uses.network) {
      add("network.topology", spell_text(e.topology.text));
      if (!has_own_workers(e)) add("network.workers", std::to_string(e.workers));
      add("network.switches", std::to_string(e.switches));
    }
    if (e.program->uses.timed) add("run.cost", spell_text(e.is_timed ? "timed" : "counted"));
    for (const auto& p : e.program->parameters)
      if (!is_void(e, p)) add(programs::key_of(p), spell(p, e.params));
  }
  const auto text = resolve(file);
  return lines.empty() ? text
                       : fmt::format("{}\n\n# By default:\n{}", text, join_texts(lines, "\n"));
}

// Chooses the columns of a second table, with loads: the axes, and the columns that the program
// declares for it. Empty if it declares none.
Texts load_columns(const ExperimentFile& file, const Table& table) {
  const auto& names = shows_of(file).loads;
  if (names.empty()) return {};
  Texts chosen = axis_names(table);
  std::ranges::copy_if(names, std::back_inserter(chosen),
                       [&](const std::string& name) { return table.find(name).has_value(); });
  return chosen;
}

// Makes the plots for an experiment that declares none.
std::vector<Plot> usual_plots(const ExperimentFile& file, const Table& table) {
  const auto plots = find_common_plots(file);
  return plots.empty() ? make_plots(table, first_result(file, table)) : make_plots(table, plots);
}

// ---- Sections of the page ----

// Lists all entries of the first model, and the entries of the other models that differ from the
// first.
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
        report.images.push_back({image.caption, folder / image.path,
                                 image.at_s.has_value() && image.path.ends_with(".png")});
}

void save_unless_empty(const fs::path& file, const Table& table) {
  if (!table.rows.empty()) base::save_whole(file, to_csv(guard_formulas(table)));
}

// If any point was completed, adds the answers to [[best]], and makes the plots that the file
// declares.
std::vector<Exhibit> add_figures(Report& report, const fs::path& folder, const Simulation& s) {
  const auto plan = plan_checks(s.file);
  const Table histograms = make_table_of(&PointResult::histogram, s.file, s.results);
  save_unless_empty(folder / "histogram.csv", histograms);
  if (std::ranges::none_of(s.table.rows,
                           [&](const auto& row) { return is_complete_row(s.table, row); }))
    return {};
  const Rows rows = make_rows(plan, s.file, s.table);
  append(report.notes, note_unknown_texts(plan, s.table));
  auto exhibits = make_exhibits(plan, rows, histograms, report.notes);
  auto answers = find_best(plan, rows);
  const auto best = make_best_csv(answers);
  if (const auto rankings = load_rankings(folder)) {
    add_rankings(answers, *rankings);
    append(report.findings, tell_rankings(*rankings));
  }
  for (const auto& answer : answers) {
    report.answers.push_back({answer.name, answer.notes, {answer.best, answer.pays}});
    append(report.findings, answer.findings);
  }
  save_unless_empty(folder / "fits.csv", make_fits_csv(exhibits));
  save_unless_empty(folder / "best.csv", best);
  save_unless_empty(folder / "pays.csv", make_pays_csv(answers));
  return exhibits;
}

// Adds the findings of the plots and of the fits. If the plots are the default ones, only the first
// or that of the speed-up has findings.
void add_findings(Report& report, const std::vector<Exhibit>& exhibits, bool are_declared) {
  std::vector<Plot> plots;
  for (const auto& exhibit : exhibits) plots.push_back(exhibit.plot);
  if (!are_declared && !plots.empty()) {
    const auto speedup = std::ranges::find(plots, "speedup", &Plot::name);
    plots = {speedup == plots.end() ? plots[0] : *speedup};
  }
  append(report.findings, plots.empty()
                              ? tell_points(report.points)
                              : tell_plots(plots, are_declared, report.table, report.points));
  for (const auto& exhibit : exhibits) append(report.findings, exhibit.findings);
}

// The figure of a plot, whose keys are in its [[plot]] or in [report].
base::FigureStyle choose_figure(const ExperimentFile& file, const std::string& plot) {
  const auto spec = std::ranges::find(file.plots, plot, &PlotSpec::name);
  return (spec == file.plots.end() ? FigureSpec{} : spec->figure).make_style(file.report.figure);
}

// Draws the plots that have points into `folder`. Their rows are those of `table`. Adds failed
// plots to `undrawn`.
void add_plots(Report& report, Texts& undrawn, const fs::path& folder, const Table& table,
               std::vector<Exhibit> exhibits) {
  std::erase_if(exhibits, [](const Exhibit& exhibit) { return !has_points(exhibit.plot); });
  std::vector<Plot> plots;
  for (auto& exhibit : exhibits) {
    choose_prefixes(exhibit.plot);
    plots.push_back(exhibit.plot);
  }
  if (plots.empty()) return;
  make_folders(folder);
  if (std::ranges::any_of(plots, [](const Plot& plot) { return plot.figure.is_figure(); }))
    make_folders(folder.parent_path() / "figures");
  const auto failures = draw_plots(plots, folder);
  for (std::size_t i = 0; i < exhibits.size(); ++i) {
    const Exhibit& e = exhibits[i];
    if (failures[i].empty())
      report.plots.push_back(
          {fmt::format("{}: {} over {}", e.plot.title, e.plot.y_label, e.plot.x_label),
           base::read_own_text(folder / (e.plot.name + ".svg")),
           {"", e.notes, {e.differences, e.fits, e.optima}},
           make_plot_data(e.plot, table)});
    else
      undrawn.push_back(failures[i]);
  }
  std::error_code ignored;
  fs::remove(folder, ignored);  // has no effect if the folder has files
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

// Keeps the rows of a table whose cell "column" is one of `columns`.
Table choose_rows(Table table, const Texts& columns) {
  const auto name = *table.find("column");
  std::erase_if(table.rows, [&](const auto& row) {
    return std::ranges::find(columns, to_string(row[name])) == columns.end();
  });
  return table;
}

// Adds the uncertainty of the results, from randomly drawn machines, and a tornado chart of what
// influences the first result.
void add_confidence(Report& report, Texts& undrawn, const fs::path& folder,
                    const base::FigureStyle& style) {
  const auto found = load_confidence(folder);
  if (!found) return;
  const auto& columns = report.shown_columns;
  const auto sentences = describe_confidence(*found, columns);
  append(report.findings, sentences);
  report.answers.push_back(
      {"Uncertainty of these results",
       sentences,
       {choose_rows(found->intervals, columns), choose_rows(found->assumptions, columns)}});
  for (const auto& column : columns) {
    const auto weights = weigh(*found, column);
    if (weights.empty()) continue;
    try {
      make_folders(folder / "plots");
      const auto drawing =
          run_gnuplot(make_tornado_script(column, weights), "tornado", tornado_height(weights));
      base::save_whole(folder / "plots/tornado.svg", drawing.svg);
      base::save_whole(folder / "plots/tornado.png", drawing.png);
      report.plots.push_back({"Influence of assumptions on " + column, drawing.svg});
      if (!style.is_figure()) return;
      make_folders(folder / "figures");
      save_figure(folder / "figures", "tornado",
                  draw_figure(make_tornado_script(column, weights, style), "tornado", style,
                              tornado_height(weights, style)));
    } catch (const std::runtime_error& error) {
      undrawn.push_back(fmt::format("tornado: {}", describe_error(error)));
    }
    return;
  }
}

}  // namespace

std::string title_of(const ExperimentFile& file) {
  const auto& title = file.points[0].experiment.title;
  return title.empty() ? fs::path(file.path).stem().string() : title;
}

Texts write_report(const fs::path& folder, const RunOptions& options, const Simulation& s) {
  Texts undrawn;
  Report report;
  report.title = title_of(s.file);
  report.question = s.file.points[0].experiment.question;
  report.table = s.table;
  if (!find_seeds(s.table).empty()) report.means = average_seeds(s.table);
  auto view = choose_view(s.file, average_seeds(s.table));
  report.shown_columns = std::move(view.columns);
  append(report.notes, view.unknown);
  if (const auto seeds = describe_seeds(s.table); !seeds.empty()) append(report.findings, {seeds});
  report.load_columns = load_columns(s.file, average_seeds(s.table));
  report.points = load_loads(folder, s);
  report.facts = make_facts(s);
  report.facts.push_back({"Points", fmt::format("{}", s.file.points.size())});
  report.facts.push_back({"Ended", s.ended});
  auto exhibits = add_figures(report, folder, s);
  if (s.file.plots.empty())
    for (const auto& plot : usual_plots(s.file, s.table)) exhibits.push_back({.plot = plot});
  if (const auto confidence = load_confidence(folder))
    for (auto& exhibit : exhibits) add_bands(exhibit.plot, s.table, *confidence);
  add_findings(report, exhibits, !s.file.plots.empty());
  if (const auto saturation = find_common_saturation(s.file)) {
    for (auto& exhibit : exhibits) mark_saturated(exhibit.plot, s.table, *saturation);
    append(report.findings, tell_saturation(s.table, *saturation));
  }
  for (auto& exhibit : exhibits) exhibit.plot.figure = choose_figure(s.file, exhibit.plot.name);
  const Table growth = make_table_of(&PointResult::growth, s.file, s.results);
  save_unless_empty(folder / "growth.csv", growth);
  save_unless_empty(folder / "means.csv", make_means_csv(s.file, s.table));
  add_plots(report, undrawn, folder / "plots", s.table, std::move(exhibits));
  std::vector<Exhibit> growths;
  for (auto& plot : plot_growth(growth)) {
    plot.figure = choose_figure(s.file, plot.name);
    growths.push_back({.plot = std::move(plot)});
  }
  add_plots(report, undrawn, folder / "plots", growth, std::move(growths));
  add_confidence(report, undrawn, folder, s.file.report.figure.make_style({}));
  append(report.notes, notes_of(s.file, s.results));
  add_images(report, folder, s);
  auto networks = draw_networks(folder, options, s);
  report.networks = std::move(networks.drawings);
  append(undrawn, networks.failures);
  append(report.notes, networks.notes);
  for (const auto& failure : undrawn) append(report.notes, {"not drawn: " + failure});
  add_checks(report, s);
  report.settings = make_settings(s.file);
  report.command = command_line(options);
  report.model = model_rows(models_of(s.file));
  base::save_whole(folder / "report.html", make_report(report));
  return undrawn;
}

void throw_undrawn(std::size_t undrawn, const std::string& results) {
  if (undrawn > 0)
    throw Failure(fmt::format("{} drawing(s) failed; the other results are in {}; repeat the "
                              "drawings with tlab report {}",
                              undrawn, results, results),
                  EXIT_HOST);
}

void report_results(const std::string& results, const Texts& columns, const FigureSpec& figure) {
  Origin origin = load_origin(results, "run.json");
  origin.options.jobs = std::max(1u, std::thread::hardware_concurrency());
  if (!columns.empty()) origin.file.report.columns = columns;
  origin.file.report.figure.override_with(figure);
  bool draws_figures = origin.file.report.figure.make_style({}).is_figure();
  for (auto& plot : origin.file.plots) {
    plot.figure.override_with(figure);
    draws_figures |= plot.figure.make_style(origin.file.report.figure).is_figure();
  }
  base::require(draws_figures || (figure.font.empty() && !figure.font_size), "--font, --font-size",
                "found no figure for a paper, expected --width column or --width page");
  ResultsFolder folder(results);
  Texts undrawn;
  try {
    const auto simulation = load_simulation(results, origin.file);
    if (!columns.empty())
      for (const auto& sentence :
           choose_view(simulation.file, average_seeds(simulation.table)).unknown)
        base::refuse("--columns", "{}", sentence);
    folder.fill([&] {
      link_files(results, folder.working());
      link_files(results / fs::path("points"), folder.working() / "points");
      link_records(results, folder.working());
      link_files(results / lone_records_folder(), folder.working() / lone_records_folder());
      undrawn = write_report(folder.working(), origin.options, simulation);
    });
  } catch (const nlohmann::json::exception& error) {
    throw make_damaged(fs::path(results) / "run.json", error);
  }
  folder.commit();
  print_out("report   {}\n", (fs::path(results) / "report.html").string());
  for (const auto& failure : undrawn) complain(failure);
  throw_undrawn(undrawn.size(), results);
}

}  // namespace laboratory

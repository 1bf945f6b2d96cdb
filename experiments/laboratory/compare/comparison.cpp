#include "experiments/laboratory/compare/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/errors.hpp"
#include "base/message.hpp"
#include "experiments/laboratory/figure/pdf.hpp"
#include "experiments/laboratory/host/error_text.hpp"
#include "experiments/laboratory/plot/gnuplot.hpp"
#include "experiments/laboratory/plot/plot.hpp"
#include "experiments/laboratory/plot/plot_data.hpp"
#include "experiments/laboratory/plot/plot_script.hpp"
#include "experiments/laboratory/points/results.hpp"
#include "experiments/laboratory/points/view.hpp"
#include "experiments/laboratory/report/report.hpp"
#include "experiments/laboratory/report/run_report.hpp"

namespace laboratory {
namespace {

using Texts = std::vector<std::string>;

constexpr std::pair<double, double> NO_BAND = {NAN, NAN};

// Names of the columns that are a setting in at least one run. These are not compared as results.
std::set<std::string> find_settings(const std::vector<ComparedRun>& runs) {
  std::set<std::string> settings;
  for (const auto& run : runs) {
    settings.merge(input_names(run.simulation.file, run.simulation.table));
    for (const auto& result : run.simulation.results)
      for (const auto& [name, cell] : result.described) settings.insert(name);
  }
  return settings;
}

// The columns that the terminal shows by default for the first run, without those that another run
// lacks.
Texts usual_columns(const std::vector<ComparedRun>& runs, const Texts& common) {
  const auto& first = runs[0].simulation;
  const auto shown = choose_view(first.file, first.table).columns;
  Texts columns;
  for (const auto& column : shown)
    if (std::ranges::find(common, column) != common.end()) columns.push_back(column);
  return columns;
}

// Sentences on the results that differ, with a last sentence on the results that are equal.
struct ResultFindings {
  Texts sentences;
  Texts differing;  ///< names of results that differ between runs; if none do, the first result
};

ResultFindings find_results(const Comparison& c) {
  ResultFindings found;
  Texts same;
  for (const auto& column : c.columns) {
    Texts sentences;
    bool differs = false;
    for (std::size_t r = 1; r < c.runs.size(); ++r) {
      const auto spread = find_spread(c.matched, r, column);
      sentences.push_back(tell_spread(c.matched, r, column, spread));
      differs = differs || !spread.is_same();
    }
    if (differs) {
      found.differing.push_back(column);
      found.sentences.insert(found.sentences.end(), sentences.begin(), sentences.end());
    } else {
      same.push_back(column);
    }
  }
  if (found.differing.empty()) found.differing.push_back(c.columns[0]);
  if (!same.empty()) found.sentences.push_back("the same in all runs: " + join_texts(same, ", "));
  return found;
}

// Lists the points and columns that are not compared, with the reasons.
Texts note_gaps(const Comparison& c) {
  Texts notes;
  for (std::size_t r = 0; r < c.runs.size(); ++r) {
    const auto& simulation = c.runs[r].simulation;
    const auto rows = simulation.table.rows.size();
    if (const auto finished = c.matched.runs[r].table.rows.size(); finished < rows)
      notes.push_back(
          fmt::format("left out: {} of {} rows of {}, because their points did not complete",
                      rows - finished, rows, c.runs[r].name));
    if (c.matched.left_out[r] > 0)
      notes.push_back(
          fmt::format("left out: {} of {} rows of {}, because not all runs have their points",
                      c.matched.left_out[r], rows, c.runs[r].name));
    if (!simulation.complete)
      notes.push_back(fmt::format("{}: {}", c.runs[r].name, simulation.ended));
  }
  return notes;
}

// Adds error bars to the curves of a plot whose table was made by stack_runs(): its rows are the
// points of the first run, then those of the second run, and so on.
void add_bars(Plot& plot, const MatchedRuns& matched) {
  const auto count = matched.points.size();
  for (auto& series : plot.series) {
    std::vector<double> low, high;
    for (const auto row : series.rows)
      if (const auto interval =
              find_interval_of(matched, matched.points[row % count], row / count, series.column)) {
        low.push_back(interval->first);
        high.push_back(interval->second);
      }
    if (low.size() < series.rows.size()) continue;
    series.low = std::move(low);
    series.high = std::move(high);
    series.has_bars = true;
  }
}

// Plots, for each run after the first, the ratio of its result to the first run's at each point.
// Adds error bars if the ratios have intervals, and a line at the ratio 1.
std::vector<Plot> plot_ratio(const MatchedRuns& matched, const std::string& column) {
  const auto name =
      fmt::format("{}, relative to {}", without_unit(make_label(column)), matched.runs[0].name);
  Table table = stack_runs(matched, {});
  table.columns.push_back(name);
  const auto count = matched.points.size();
  table.rows.erase(table.rows.begin(), table.rows.begin() + static_cast<std::ptrdiff_t>(count));
  std::vector<std::pair<double, double>> bands;
  double least = 1, most = 1;  // limits of the y axis, which always includes the ratio 1
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const auto ratio = find_ratio(matched, matched.points[i % count], 1 + i / count, column);
    auto& cell = table.rows[i].emplace_back();
    if (ratio) cell = ratio->value;
    bands.push_back(ratio && ratio->interval ? *ratio->interval : NO_BAND);
    if (!ratio) continue;
    const auto [low, high] = ratio->interval.value_or(std::pair(ratio->value, ratio->value));
    least = std::min(least, low);
    most = std::max(most, high);
  }
  auto plots = make_plots(table, {name});
  for (auto& plot : plots) {
    plot.name = "ratio";
    plot.level = 1;
    const double margin = std::max(0.001, 0.05 * (most - least));
    plot.y_min = least - margin;
    plot.y_max = most + margin;
    for (auto& series : plot.series) {
      const bool has_bands = std::ranges::all_of(
          series.rows, [&](std::size_t row) { return std::isfinite(bands[row].first); });
      for (const auto row : has_bands ? series.rows : RowList{}) {
        series.low.push_back(bands[row].first);
        series.high.push_back(bands[row].second);
      }
      series.has_bars = has_bands;
    }
  }
  return plots;
}

void draw(Report& page, Texts& undrawn, const PaperFigures& figures, Plot plot,
          const std::string& data) {
  if (!has_points(plot)) return;
  try {
    const auto script = make_gnuplot_script(plot);
    page.plots.push_back({fmt::format("{} over {}", plot.y_label, plot.x_label),
                          run_gnuplot(script, plot.name, choose_height(plot)).svg,
                          {},
                          data});
    plot.figure = figures.style;
    if (plot.figure.is_figure()) save_figure(figures.folder, plot.name, draw_figure(plot));
  } catch (const std::runtime_error& error) {
    undrawn.push_back(fmt::format("{}: {}", plot.name, describe_error(error)));
    page.notes.push_back("not drawn: " + undrawn.back());
  }
}

Texts name_runs(const Comparison& c) {
  Texts lines;
  for (const auto& run : c.runs) lines.push_back(fmt::format("{}: {}", run.name, run.command));
  return lines;
}

}  // namespace

Comparison compare_runs(const Texts& folders, const Texts& columns) {
  Comparison c{.runs = load_runs(folders), .matched = {}, .columns = columns};
  c.matched = match_points(make_tables(c.runs));
  auto common = find_common_results(c.matched.runs);
  const auto settings = find_settings(c.runs);
  std::erase_if(common, [&](const auto& column) { return settings.contains(column); });
  for (const auto& column : columns) {
    base::require(!settings.contains(column), "--columns",
                  "found the setting {}, expected a result (different settings are always listed)",
                  column);
    if (std::ranges::find(common, column) == common.end())
      throw base::BadInput(fmt::format("--columns: {} is not a number that all runs have{}", column,
                                       base::suggest(column, common)));
  }
  if (c.columns.empty()) c.columns = usual_columns(c.runs, common);
  if (c.columns.empty()) c.columns = common;
  if (c.columns.empty())
    throw base::BadInput("compare: found no numeric result in all runs, expected at least one");
  return c;
}

std::string to_text(const Comparison& c) {
  std::string text;
  const auto add_lines = [&](const Texts& lines) {
    for (const auto& line : lines) text += line + "\n";
  };
  const auto add_table = [&](const std::string& title, const Table& table) {
    if (!table.rows.empty()) text += "\n" + title + ":\n" + to_text(table);
  };
  add_lines(name_runs(c));
  add_table("Settings that differ", find_differing_settings(c.runs));
  add_table("Entries of the machine models that differ", find_differing_entries(c.runs));
  text += "\n";
  const auto found = find_results(c);
  add_lines(note_gaps(c));
  add_lines(found.sentences);
  add_table(found.differing[0] + " at each point", compare_column(c.matched, found.differing[0]));
  return text;
}

std::string to_page(const Comparison& c, const PaperFigures& figures, Texts& undrawn) {
  Report page;
  Texts names;
  for (const auto& run : c.runs) names.push_back(run.name);
  page.title = join_texts(names, " and ");
  page.question = join_texts(name_runs(c), "; ");
  const auto found = find_results(c);
  page.findings = found.sentences;
  page.notes = note_gaps(c);
  page.answers.push_back({"Settings that differ", {}, {find_differing_settings(c.runs)}});
  page.answers.push_back(
      {"Entries of the machine models that differ", {}, {find_differing_entries(c.runs)}});
  for (const auto& column : found.differing)
    page.answers.push_back({column, {}, {compare_column(c.matched, column)}});
  page.table = stack_runs(c.matched, c.columns);
  for (const auto& plot : plot_ratio(c.matched, found.differing[0]))
    draw(page, undrawn, figures, plot, {});
  for (auto& plot : make_plots(page.table, found.differing)) {
    add_bars(plot, c.matched);
    draw(page, undrawn, figures, plot, make_plot_data(plot, page.table));
  }
  page.command = join_texts(name_runs(c), "\n");
  return make_report(page);
}

}  // namespace laboratory

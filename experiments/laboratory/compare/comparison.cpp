#include "experiments/laboratory/compare/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "base/message.hpp"
#include "experiments/laboratory/report/gnuplot.hpp"
#include "experiments/laboratory/report/plot.hpp"
#include "experiments/laboratory/report/plot_data.hpp"
#include "experiments/laboratory/report/plot_script.hpp"
#include "experiments/laboratory/report/report.hpp"
#include "experiments/laboratory/report/run_report.hpp"

namespace laboratory {
namespace {

using Texts = std::vector<std::string>;

constexpr std::pair<double, double> NO_BAND = {NAN, NAN};

// What the first run's program is usually asked for, as far as all have it.
Texts usual_columns(const std::vector<ComparedRun>& runs, const Texts& common) {
  const auto& first = runs[0].simulation;
  const auto shown = shown_columns(first.file, first.table);
  Texts columns;
  for (const auto& column : shown)
    if (std::ranges::find(common, column) != common.end()) columns.push_back(column);
  return columns;
}

// What each result does, and which ones differ.
struct Told {
  Texts sentences;
  Texts differing;  ///< the results that are not the same in all runs; if there are none, the first
};

Told tell_results(const Comparison& c) {
  const auto tables = tables_of(c.runs);
  Told told;
  Texts same;
  for (const auto& column : c.columns) {
    Texts sentences;
    bool differs = false;
    for (std::size_t r = 1; r < c.runs.size(); ++r)
      if (const auto spread = find_spread(tables, c.matched, r, column)) {
        sentences.push_back(tell_spread(tables, c.matched, r, column, *spread));
        differs = differs || !spread->is_same();
      }
    if (!differs && !sentences.empty()) same.push_back(column);
    if (!differs) continue;
    told.differing.push_back(column);
    told.sentences.insert(told.sentences.end(), sentences.begin(), sentences.end());
  }
  if (told.differing.empty()) told.differing.push_back(c.columns[0]);
  if (!same.empty()) told.sentences.push_back("the same in all runs: " + join_texts(same, ", "));
  return told;
}

// Rows that not all runs have, and runs that did not come to their end.
Texts note_gaps(const Comparison& c) {
  Texts notes;
  for (std::size_t r = 0; r < c.runs.size(); ++r) {
    if (c.matched.left_out[r] > 0)
      notes.push_back(fmt::format("{} of {} rows of {} are of points that not all runs have",
                                  c.matched.left_out[r], c.runs[r].simulation.table.rows.size(),
                                  c.runs[r].name));
    if (!c.runs[r].simulation.complete)
      notes.push_back(fmt::format("{}: {}", c.runs[r].name, c.runs[r].simulation.ended));
  }
  return notes;
}

// How many times the first run's a result is, over the points; with bands where there are seeds.
std::vector<Plot> plot_ratio(const Comparison& c, const std::string& column) {
  const auto tables = tables_of(c.runs);
  const auto name = fmt::format("{}, times that of {}", column, c.runs[0].name);
  Table table = stack_runs(tables, c.matched, {});
  table.columns.push_back(name);
  table.rows.erase(table.rows.begin(),
                   table.rows.begin() + static_cast<std::ptrdiff_t>(c.matched.points.size()));
  std::vector<std::pair<double, double>> bands;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const auto& point = c.matched.points[i % c.matched.points.size()];
    const auto ratio =
        find_ratio(tables, c.matched, point, 1 + i / c.matched.points.size(), column);
    auto& cell = table.rows[i].emplace_back();
    if (ratio) cell = ratio->value;
    bands.push_back(ratio && ratio->interval ? *ratio->interval : NO_BAND);
  }
  auto plots = make_plots(table, {name});
  for (auto& plot : plots) {
    plot.name = "ratio";
    for (auto& series : plot.series) {
      const bool has_bands = std::ranges::all_of(
          series.rows, [&](std::size_t row) { return std::isfinite(bands[row].first); });
      for (const auto row : has_bands ? series.rows : RowList{}) {
        series.low.push_back(bands[row].first);
        series.high.push_back(bands[row].second);
      }
    }
  }
  return plots;
}

void draw(Report& page, Texts& undrawn, const Plot& plot, const std::string& data) {
  if (!has_points(plot)) return;
  try {
    const auto script = make_gnuplot_script(plot);
    page.plots.push_back({fmt::format("{} over {}", plot.y_label, plot.x_label),
                          run_gnuplot(script, plot.name, choose_height(plot)).svg,
                          {},
                          data});
  } catch (const std::runtime_error& error) {
    undrawn.push_back(fmt::format("{}: {}", plot.name, error.what()));
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
  const auto tables = tables_of(c.runs);
  c.matched = match_points(tables);
  if (c.matched.points.empty())
    throw base::BadInput(fmt::format("compare: {} and {} have no point in common", c.runs[0].folder,
                                     c.runs[1].folder));
  const auto common = common_results(tables);
  for (const auto& column : columns)
    if (std::ranges::find(common, column) == common.end())
      throw base::BadInput(fmt::format("--columns: {} is no number that all runs have{}", column,
                                       base::suggest(column, common)));
  if (c.columns.empty()) c.columns = usual_columns(c.runs, common);
  if (c.columns.empty()) c.columns = common;
  if (c.columns.empty())
    throw base::BadInput("compare: found no number that is a result of all runs");
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
  add_table("Settings that differ", differing_settings(c.runs));
  add_table("Entries of the machine models that differ", differing_entries(c.runs));
  text += "\n";
  const auto told = tell_results(c);
  add_lines(note_gaps(c));
  add_lines(told.sentences);
  add_table(told.differing[0] + " at each point",
            compare_column(tables_of(c.runs), c.matched, told.differing[0]));
  return text;
}

Table to_table(const Comparison& c) {
  Table all;
  for (const auto& column : c.columns) {
    const auto tables = tables_of(c.runs);
    Table table = compare_column(tables, c.matched, column);
    for (std::size_t i = 0; i < c.runs.size(); ++i)
      table.columns[table.axes + i] = c.runs[i].name;  // without the result's name
    if (all.columns.empty()) {
      all.columns = table.columns;
      all.axes = table.axes + 1;
      all.columns.insert(all.columns.begin(), "result");
    }
    for (auto& row : table.rows) {
      row.insert(row.begin(), Value(column));
      row.resize(all.columns.size());
      all.rows.push_back(std::move(row));
    }
  }
  return all;
}

std::string to_page(const Comparison& c, Texts& undrawn) {
  Report page;
  Texts names;
  for (const auto& run : c.runs) names.push_back(run.name);
  page.title = join_texts(names, " and ");
  page.question = join_texts(name_runs(c), "; ");
  const auto told = tell_results(c);
  page.findings = told.sentences;
  page.notes = note_gaps(c);
  const auto tables = tables_of(c.runs);
  page.answers.push_back({"Settings that differ", {}, {differing_settings(c.runs)}});
  page.answers.push_back(
      {"Entries of the machine models that differ", {}, {differing_entries(c.runs)}});
  for (const auto& column : told.differing)
    page.answers.push_back({column, {}, {compare_column(tables, c.matched, column)}});
  page.table = stack_runs(tables, c.matched, c.columns);
  for (const auto& plot : plot_ratio(c, told.differing[0])) draw(page, undrawn, plot, {});
  for (const auto& plot : make_plots(page.table, told.differing))
    draw(page, undrawn, plot, make_plot_data(plot, page.table));
  page.command = join_texts(name_runs(c), "\n");
  return make_report(page);
}

}  // namespace laboratory

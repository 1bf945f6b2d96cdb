#include "experiments/laboratory/report/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include "experiments/laboratory/points/results.hpp"

namespace laboratory {
namespace {

std::optional<std::size_t> choose_x(const Table& table) {
  std::optional<std::size_t> chosen;
  for (std::size_t axis = table.axes; axis-- > 0;) {
    if (!is_numeric(table, axis) || distinct(table, all_rows(table), axis).size() < 2) continue;
    if (table.columns[axis] == "workers") return axis;
    chosen = axis;
  }
  return chosen;
}

std::vector<Series> make_series(const Table& table, std::size_t x, std::size_t y) {
  const auto others = choose_series_axes(table, all_rows(table), {x});
  std::vector<Series> all;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    // skips incomplete points, whose values are not final
    if (!is_complete_row(table, table.rows[row])) continue;
    const auto at = as_number(table.rows[row][x]), value = as_number(table.rows[row][y]);
    if (!at || !value || !std::isfinite(*at) || !std::isfinite(*value)) continue;
    add_point(all, name_values(table, row, others), row, *at, *value);
  }
  sort_points(all);
  for (auto& series : all) series.column = table.columns[y];
  return all;
}

// Makes the plot of column y on linear scales. It has no series if y has no values.
Plot make_plot(const Table& table, std::size_t x, std::size_t y) {
  Plot plot;
  plot.name = table.columns[y];
  plot.x_label = make_label(table.columns[x]);
  plot.y_label = make_label(plot.name);
  plot.series = make_series(table, x, y);
  return plot;
}

// Names the axes that have a single value, with that value.
std::string name_constants(const Table& table) {
  if (table.rows.empty()) return {};
  std::vector<std::size_t> constant;
  for (std::size_t axis = 0; axis < table.axes; ++axis)
    if (distinct(table, all_rows(table), axis).size() < 2) constant.push_back(axis);
  return name_values(table, 0, constant);
}

double choose_efficiency_end(const Plot& plot) {
  double end = 1.05;
  for (const auto& series : plot.series) end = std::max(end, 1.05 * std::ranges::max(series.y));
  return end;
}

}  // namespace

std::string Series::key() const {
  return fitted.empty() ? name : fmt::format("{} ({})", name, fitted);
}

std::vector<std::size_t> choose_series_axes(const Table& table, const RowList& rows,
                                            const std::vector<std::size_t>& x) {
  std::vector<std::size_t> axes;
  for (std::size_t axis = 0; axis < table.axes; ++axis)
    if (std::ranges::find(x, axis) == x.end() && distinct(table, rows, axis).size() > 1 &&
        !is_determined(table, rows, axis, x))
      axes.push_back(axis);
  return axes;
}

void add_point(std::vector<Series>& all, const std::string& name, std::size_t row, double x,
               double y) {
  auto series = std::ranges::find(all, name, &Series::name);
  if (series == all.end()) series = all.insert(all.end(), Series{.name = name, .x = {}, .y = {}});
  series->x.push_back(x);
  series->y.push_back(y);
  series->rows.push_back(row);
}

void add_bands(Plot& plot, const Table& table, const ConfidenceTables& confidence) {
  for (auto& series : plot.series) {
    if (series.kind != SeriesKind::curve || series.column.empty()) continue;
    std::vector<double> low = series.y, high = series.y;
    bool is_wide = false;
    for (std::size_t i = 0; i < series.rows.size(); ++i)
      if (const auto interval = find_interval(confidence, table, series.rows[i], series.column)) {
        std::tie(low[i], high[i]) = *interval;
        is_wide = true;
      }
    if (!is_wide) continue;
    series.low = std::move(low);
    series.high = std::move(high);
  }
}

void sort_points(std::vector<Series>& all) {
  for (auto& series : all) {
    std::vector<std::size_t> order(series.x.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return series.x[i]; });
    const auto pick = [&](auto& values) {
      auto picked = values;
      for (std::size_t i = 0; i < order.size(); ++i) picked[i] = values[order[i]];
      values = picked;
    };
    pick(series.x);
    pick(series.y);
    pick(series.rows);
  }
}

bool wants_log_x(const std::string& column, const std::vector<double>& values) {
  if (!is_geometric(values)) return false;
  return column != "workers" || std::ranges::max(values) >= 32 * std::ranges::min(values);
}

std::vector<Plot> make_plots(const Table& table, const std::vector<programs::UsualPlot>& usual) {
  const auto x = choose_x(table);
  if (!x) return {};
  const bool over_workers = table.columns[*x] == "workers";
  const bool log_x = wants_log_x(table.columns[*x], numbers_of(table, all_rows(table), *x));
  const auto where = name_constants(table);
  std::vector<Plot> plots;
  for (const auto& [column, title] : usual) {
    const auto y = table.find(column);
    if (!y || *y < table.axes) continue;
    Plot plot = make_plot(table, *x, *y);
    if (plot.series.empty()) continue;
    plot.title = title + (where.empty() ? "" : ": " + where);
    plot.y_min = 0;
    plot.log_x = log_x;
    plot.log_y = log_x && over_workers && plot.name != "efficiency";
    plot.ideal_line = plot.is_speedup = plot.name == "speedup" && over_workers;
    if (plot.name == "efficiency") plot.y_max = choose_efficiency_end(plot);
    plots.push_back(std::move(plot));
  }
  return plots;
}

std::vector<Plot> make_plots(const Table& table, const std::vector<std::string>& columns) {
  const auto x = choose_x(table);
  const auto rows = all_rows(table);
  std::vector<Plot> plots;
  for (const auto& column : columns) {
    const auto y = table.find(column);
    if (!x || !y) continue;
    Plot plot = make_plot(table, *x, *y);
    if (plot.series.empty()) continue;
    plot.title = without_unit(plot.y_label);
    plot.log_x = is_geometric(numbers_of(table, rows, *x));
    plot.log_y = plot.log_x && is_geometric(numbers_of(table, rows, *y));
    if (!plot.log_y) plot.y_min = 0;
    plots.push_back(std::move(plot));
  }
  return plots;
}

}  // namespace laboratory

// From a sweep's table to its usual plots.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "experiments/laboratory/points/results.hpp"
#include "experiments/laboratory/report/plot.hpp"
#include "experiments/laboratory/table/axis_values.hpp"

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

// The axes that vary apart from x.
std::vector<std::size_t> choose_others(const Table& table, std::size_t x) {
  const auto rows = all_rows(table);
  std::vector<std::size_t> others;
  for (std::size_t axis = 0; axis < table.axes; ++axis)
    if (axis != x && distinct(table, rows, axis).size() > 1 &&
        !is_determined(table, rows, axis, {x}))
      others.push_back(axis);
  return others;
}

std::vector<Series> make_series(const Table& table, std::size_t x, std::size_t y,
                                const std::vector<std::size_t>& others) {
  std::vector<Series> all;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    if (!is_complete_row(table, table.rows[row])) continue;  // cut short: half a result
    const auto at = as_number(table.rows[row][x]), value = as_number(table.rows[row][y]);
    if (!at || !value || !std::isfinite(*at) || !std::isfinite(*value)) continue;
    auto name = name_values(table, row, others);
    auto series = std::ranges::find(all, name, &Series::name);
    if (series == all.end()) series = all.insert(all.end(), Series{.name = name, .x = {}, .y = {}});
    series->x.push_back(*at);
    series->y.push_back(*value);
  }
  std::ranges::for_each(all, sort_by_x);
  return all;
}

// The axes of one value.
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

void sort_by_x(Series& series) {
  std::vector<std::size_t> order(series.x.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return series.x[i]; });
  const Series unsorted = series;
  for (std::size_t i = 0; i < order.size(); ++i) {
    series.x[i] = unsorted.x[order[i]];
    series.y[i] = unsorted.y[order[i]];
  }
}

bool wants_log_x(const std::string& column, const std::vector<double>& values) {
  if (!is_geometric(values)) return false;
  return column != "workers" || std::ranges::max(values) >= 32 * std::ranges::min(values);
}

std::vector<Plot> make_plots(const Table& table) {
  const auto x = choose_x(table);
  if (!x) return {};
  const bool over_workers = table.columns[*x] == "workers";
  const bool log_x = wants_log_x(table.columns[*x], numbers_of(table, all_rows(table), *x));
  const auto others = choose_others(table, *x);
  const auto where = name_constants(table);

  std::vector<Plot> plots;
  for (const auto& [column, title] : {std::pair{"time_s", "Time"},
                                      {"time_per_ray_ms", "Time per ray"},
                                      {"speedup", "Speed-up"},
                                      {"efficiency", "Efficiency"}}) {
    const auto y = table.find(column);
    if (!y || *y < table.axes) continue;
    Plot plot{.name = column,
              .title = title + (where.empty() ? "" : ": " + where),
              .x_label = make_label(table.columns[*x]),
              .y_label = make_label(column),
              .series = make_series(table, *x, *y, others),
              .log_x = log_x,
              .y_min = 0,
              .y_max = {}};
    if (plot.series.empty()) continue;
    plot.ideal_line = plot.name == "speedup" && over_workers;
    plot.log_y = plot.log_x && over_workers && plot.name != "efficiency";
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
    const auto label = make_label(column);
    const bool log_x = is_geometric(numbers_of(table, rows, *x));
    Plot plot{.name = column,
              .title = label.substr(0, label.rfind(" [")),
              .x_label = make_label(table.columns[*x]),
              .y_label = label,
              .series = make_series(table, *x, *y, choose_others(table, *x)),
              .log_x = log_x,
              .log_y = log_x && is_geometric(numbers_of(table, rows, *y)),
              .y_min = {},
              .y_max = {}};
    if (!plot.log_y) plot.y_min = 0;
    if (!plot.series.empty()) plots.push_back(std::move(plot));
  }
  return plots;
}

}  // namespace laboratory

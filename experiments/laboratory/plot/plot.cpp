#include "experiments/laboratory/plot/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "experiments/laboratory/points/results.hpp"

namespace laboratory {
namespace {

std::optional<std::size_t> choose_x(const Table& table) {
  std::optional<std::size_t> chosen;
  for (std::size_t axis = table.axes; axis-- > 0;) {
    if (is_seed(table.columns[axis]) || !is_numeric(table, axis) ||
        distinct(table, all_rows(table), axis).size() < 2)
      continue;
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
  average_points(all, table);
  sort_points(all);
  for (auto& series : all) series.column = table.columns[y];
  return all;
}

// Makes the plot of column y over column x, on linear scales. It has no series if y has no values.
Plot make_plot(const Table& table, std::size_t x, std::size_t y) {
  Plot plot;
  plot.name = table.columns[y];
  plot.x_label = make_label(table.columns[x]);
  plot.y_label = make_label(plot.name);
  plot.series = make_series(table, x, y);
  plot.legend_title =
      label_series(plot.series, table, choose_series_axes(table, all_rows(table), {x}));
  return plot;
}

// Formats the values of the axes that have a single value.
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
  return fitted.empty() ? short_name() : fmt::format("{} ({})", short_name(), fitted);
}

std::vector<std::size_t> choose_series_axes(const Table& table, const RowList& rows,
                                            const std::vector<std::size_t>& x) {
  std::vector<std::size_t> axes;
  for (std::size_t axis = 0; axis < table.axes; ++axis)
    if (std::ranges::find(x, axis) == x.end() && !is_seed(table.columns[axis]) &&
        distinct(table, rows, axis).size() > 1) {
      auto before = x;
      before.insert(before.end(), axes.begin(), axes.end());
      if (!is_determined(table, rows, axis, before)) axes.push_back(axis);
    }
  return axes;
}

std::string label_series(std::vector<Series>& all, const Table& table,
                         const std::vector<std::size_t>& axes) {
  std::vector<std::string> names;
  for (const auto axis : axes) names.push_back(make_label(table.columns[axis]));
  for (auto& series : all) {
    if (series.rows.empty() || axes.empty()) continue;
    std::vector<std::string> values;
    for (const auto axis : axes) values.push_back(to_string(table.rows[series.rows[0]][axis]));
    series.label = join_texts(values, ", ");
  }
  return join_texts(names, ", ");
}

void add_point(std::vector<Series>& all, const std::string& name, std::size_t row, double x,
               double y) {
  auto series = std::ranges::find(all, name, &Series::name);
  if (series == all.end()) series = all.insert(all.end(), Series{.name = name, .x = {}, .y = {}});
  series->x.push_back(x);
  series->y.push_back(y);
  series->rows.push_back(row);
}

void average_points(std::vector<Series>& all, const Table& table) {
  if (find_seeds(table).empty()) return;
  const auto group_of = number_samples(table);
  for (auto& series : all) {
    std::vector<RowSamples> samples;
    // indices in `samples`, by the row's group and x
    std::map<std::pair<std::size_t, double>, std::size_t> known;
    std::vector<double> xs;
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      const auto at = std::pair(group_of[series.rows[i]], series.x[i]);
      const auto [point, is_new] = known.emplace(at, samples.size());
      if (is_new) {
        samples.emplace_back();
        xs.push_back(series.x[i]);
      }
      samples[point->second].rows.push_back(series.rows[i]);
      samples[point->second].values.push_back(series.y[i]);
    }
    series.x = std::move(xs);
    series.y.clear();
    series.rows.clear();
    for (const auto& sample : samples) {
      const auto mean = find_mean_interval(sample.values);
      series.rows.push_back(sample.rows[0]);
      series.y.push_back(mean.mean);
      series.low.push_back(mean.low());
      series.high.push_back(mean.high());
    }
    series.samples = std::move(samples);
    series.has_bars = true;
  }
}

void add_bands(Plot& plot, const Table& table, const ConfidenceTables& confidence) {
  for (auto& series : plot.series) {
    if (series.kind != SeriesKind::curve || series.column.empty() || series.has_bars) continue;
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
      for (std::size_t i = 0; i < picked.size(); ++i) picked[i] = values[order[i]];
      values = picked;
    };
    pick(series.x);
    pick(series.y);
    pick(series.rows);
    pick(series.low);
    pick(series.high);
    pick(series.samples);
  }
}

namespace {

// The growth of the picture of one point: values by simulated time.
using Growth = std::map<double, double>;

// The value at a time, linearly interpolated; no value before the first time.
std::optional<double> find_growth(const Growth& growth, double time) {
  const auto after = growth.lower_bound(time);
  if (after == growth.end()) return growth.rbegin()->second;
  if (after->first == time) return after->second;
  if (after == growth.begin()) return std::nullopt;
  const auto before = std::prev(after);
  const double share = (time - before->first) / (after->first - before->first);
  return before->second + share * (after->second - before->second);
}

// Groups the rows of points that differ only in the seed. Without seeds, each point is a group.
std::vector<RowList> group_growths(const Table& growth, const RowList& rows) {
  if (!find_seeds(growth).empty()) return group_samples(growth, rows);
  std::map<std::size_t, RowList> by_point;
  for (const auto row : rows) by_point[growth.point_of(row)].push_back(row);
  std::vector<RowList> groups;
  for (auto& [point, group] : by_point) groups.push_back(std::move(group));
  return groups;
}

// Makes the curve of a group of points. If the group has several points, the curve shows means, at
// the times of the picture that is finished last.
Series average_growth(const Table& growth, const RowList& rows, std::size_t time, std::size_t y) {
  std::map<std::size_t, Growth> pictures;  // growth of the points' pictures, by point
  std::map<std::size_t, std::map<double, std::size_t>> row_of;
  for (const auto row : rows)
    if (const auto value = as_number(growth.rows[row][y]); value && std::isfinite(*value)) {
      const double at = *as_number(growth.rows[row][time]);
      pictures[growth.point_of(row)][at] = *value;
      row_of[growth.point_of(row)][at] = row;
    }
  Series series{.name = "", .x = {}, .y = {}};
  if (pictures.empty()) return series;
  const auto longest = std::ranges::max_element(pictures, {}, [](const auto& picture) {
                         return picture.second.rbegin()->first;
                       })->first;
  for (const auto& [at, row] : row_of[longest]) {
    RowSamples samples;
    for (const auto& [point, picture] : pictures)
      if (const auto value = find_growth(picture, at)) {
        samples.rows.push_back(row_of[point].begin()->second);
        samples.values.push_back(*value);
      }
    if (samples.rows.size() < pictures.size()) continue;
    const auto mean = find_mean_interval(samples.values);
    series.x.push_back(at);
    series.y.push_back(mean.mean);
    series.rows.push_back(row);
    if (pictures.size() < 2) continue;
    series.low.push_back(mean.low());
    series.high.push_back(mean.high());
    series.samples.push_back(std::move(samples));
    series.has_bars = true;
  }
  return series;
}

}  // namespace

std::vector<Plot> plot_growth(const Table& growth) {
  if (growth.rows.empty()) return {};
  const auto rows = all_rows(growth);
  const auto axes = choose_series_axes(growth, rows, {});
  const auto time = *growth.find("growth_s");
  std::vector<Plot> plots;
  for (const auto& [column, title, label] :
       {std::tuple{"ssim", "Growth of the picture: likeness",
                   "structural similarity to the final picture"},
        {"border_energy", "Growth of the picture: visible cells",
         "second differences: across borders of cells / inside"}}) {
    Plot plot;
    plot.name = fmt::format("growth-{}", column);
    plot.title = title;
    plot.x_label = "simulated time [s]";
    plot.y_label = label;
    plot.log_y = std::string_view(column) == "border_energy";
    for (const auto& group : group_growths(growth, rows)) {
      auto series = average_growth(growth, group, time, *growth.find(column));
      if (series.x.empty()) continue;
      series.name = name_values(growth, group[0], axes);
      plot.series.push_back(std::move(series));
    }
    if (plot.series.size() == 1)
      plot.series[0].name = "";
    else
      plot.legend_title = label_series(plot.series, growth, axes);
    plots.push_back(std::move(plot));
  }
  return plots;
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

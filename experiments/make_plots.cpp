// From a sweep's table to its plots.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "experiments/plot.hpp"

namespace experiments {
namespace {

// The different values of a column, in the order of rows; empty cells do not count.
std::vector<Value> distinct(const Table& table, std::size_t column) {
  std::vector<Value> values;
  for (const auto& row : table.rows) {
    const Value& value = row.at(column);
    if (std::holds_alternative<std::monostate>(value)) continue;
    if (std::ranges::find(values, value) == values.end()) values.push_back(value);
  }
  return values;
}

std::optional<std::size_t> choose_x(const Table& table) {
  std::optional<std::size_t> chosen;
  for (std::size_t axis = table.axes; axis-- > 0;) {
    if (!is_numeric(table, axis) || distinct(table, axis).size() < 2) continue;
    if (table.columns[axis] == "workers") return axis;
    chosen = axis;
  }
  return chosen;
}

// "3200 objects", "tree", "depth 3", "link rate 20 Mbit/s"
std::string name_value(const std::string& axis, const Value& value) {
  const auto text = to_string(value), label = make_label(axis);
  if (!as_number(value) && text != "true" && text != "false") return text;
  const auto unit = label.rfind(" [");
  if (unit != std::string::npos)
    return fmt::format("{} {} {}", label.substr(0, unit), text,
                       label.substr(unit + 2, label.size() - unit - 3));
  if (!label.ends_with('s')) return fmt::format("{} {}", label, text);
  const std::size_t plural = label.ends_with("ches") ? 2 : 1;
  return fmt::format("{} {}", text, text == "1" ? label.substr(0, label.size() - plural) : label);
}

std::string name_row(const Table& table, const std::vector<Value>& row,
                     const std::vector<std::size_t>& axes) {
  std::string name;
  for (const std::size_t axis : axes) {
    if (std::holds_alternative<std::monostate>(row[axis])) continue;
    name += (name.empty() ? "" : ", ") + name_value(table.columns[axis], row[axis]);
  }
  return name;
}

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

std::vector<Series> make_series(const Table& table, std::size_t x, std::size_t y,
                                const std::vector<std::size_t>& others) {
  std::vector<Series> all;
  for (const auto& row : table.rows) {
    const auto at = as_number(row[x]), value = as_number(row[y]);
    if (!at || !value || !std::isfinite(*at) || !std::isfinite(*value)) continue;
    auto name = name_row(table, row, others);
    auto series = std::ranges::find(all, name, &Series::name);
    if (series == all.end()) series = all.insert(all.end(), Series{.name = name, .x = {}, .y = {}});
    series->x.push_back(*at);
    series->y.push_back(*value);
  }
  std::ranges::for_each(all, sort_by_x);
  return all;
}

// An axis like 50, 200, 800, 3200 would crowd its points to the left.
bool is_geometric(const Table& table, std::size_t axis) {
  double smallest = INFINITY, largest = 0;
  for (const auto& value : distinct(table, axis)) {
    smallest = std::min(smallest, as_number(value).value_or(0));
    largest = std::max(largest, as_number(value).value_or(0));
  }
  return smallest > 0 && largest / smallest >= 16;
}

}  // namespace

std::vector<Plot> make_plots(const Table& table) {
  const auto x = choose_x(table);
  if (!x) return {};
  std::vector<std::size_t> varying, constant;
  for (std::size_t axis = 0; axis < table.axes; ++axis)
    if (axis != *x) (distinct(table, axis).size() > 1 ? varying : constant).push_back(axis);
  const bool over_workers = table.columns[*x] == "workers";
  const auto where = table.rows.empty() ? "" : name_row(table, table.rows[0], constant);

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
              .series = make_series(table, *x, *y, varying),
              .log_x = !over_workers && is_geometric(table, *x),
              .y_min = 0,
              .y_max = {}};
    if (plot.series.empty()) continue;
    plot.ideal_line = plot.name == "speedup" && over_workers;
    if (plot.name == "efficiency") {
      plot.y_max = 1.05;
      for (const auto& series : plot.series)
        plot.y_max = std::max(*plot.y_max, 1.05 * std::ranges::max(series.y));
    }
    plots.push_back(std::move(plot));
  }
  return plots;
}

std::vector<Plot> make_plots(const Table& table, const std::vector<std::string>& columns) {
  const auto x = choose_x(table);
  std::vector<Plot> plots;
  std::vector<std::size_t> others;
  for (std::size_t axis = 0; axis < table.axes; ++axis)
    if (x && axis != *x && distinct(table, axis).size() > 1) others.push_back(axis);
  for (const auto& column : columns) {
    const auto y = table.find(column);
    if (!x || !y) continue;
    const auto label = make_label(column);
    Plot plot{.name = column,
              .title = label.substr(0, label.rfind(" [")),
              .x_label = make_label(table.columns[*x]),
              .y_label = label,
              .series = make_series(table, *x, *y, others),
              .log_x = is_geometric(table, *x),
              .log_y = is_geometric(table, *x) && is_geometric(table, *y),
              .y_min = {},
              .y_max = {}};
    if (!plot.log_y) plot.y_min = 0;
    if (!plot.series.empty()) plots.push_back(std::move(plot));
  }
  return plots;
}

}  // namespace experiments

#include "experiments/laboratory/plot/plot_axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace laboratory {
namespace {

// The points of a series that can be drawn on a logarithmic or linear scale of y.
std::vector<Dot> drawn_points(const Plot& plot, const Series& s, bool log_y) {
  if (s.x.size() != s.y.size())
    throw std::invalid_argument(fmt::format("plot {}: the series \"{}\" has {} x but {} y",
                                            plot.name, s.name, s.x.size(), s.y.size()));
  std::vector<Dot> points;
  for (std::size_t i = 0; i < s.x.size(); ++i)
    if (std::isfinite(s.x[i]) && std::isfinite(s.y[i]) && (!plot.log_x || s.x[i] > 0) &&
        (!log_y || s.y[i] > 0))
      points.push_back({s.x[i], s.y[i]});
  return points;
}

}  // namespace

std::vector<Dot> upper_points(const Plot& plot, const Series& series) {
  return drawn_points(plot, series, plot.log_y);
}

// The points of a series in the lower panel, whose scale is always linear.
std::vector<Dot> lower_points(const Plot& plot, const Series& series) {
  return drawn_points(plot, series, false);
}

namespace {

bool is_power_of_two(double value) {
  return value > 0 && std::exp2(std::round(std::log2(value))) == value;
}

}  // namespace

Axes measure_axes(const Plot& plot) {
  Axes axes;
  for (const auto& series : plot.series)
    for (const auto& point : upper_points(plot, series)) {
      axes.x.add(point.x);
      axes.y.add(point.y);
      if (series.kind != SeriesKind::law && !series.is_stepped) axes.marks.insert(point.x);
    }
  for (const auto& series : plot.series)
    for (std::size_t i = 0; i < series.low.size(); ++i)
      for (const double edge : {series.low[i], series.high[i]})
        if (!plot.log_y || edge > 0) axes.y.add(edge);
  for (const auto& series : plot.differences)
    for (const auto& point : lower_points(plot, series)) {
      axes.x.add(point.x);
      axes.difference.add(point.y);
    }
  axes.is_doubling =
      plot.log_x && !axes.marks.empty() && std::ranges::all_of(axes.marks, is_power_of_two);
  return axes;
}

// The base of a logarithmic scale is 2 for x if its ticks are powers of two, and then also for y if
// there is an ideal line. Otherwise it is 10.
std::string make_scales(const Plot& plot, const Axes& axes) {
  const int x_base = axes.is_doubling ? 2 : 10;
  std::string text;
  if (plot.log_x) text += fmt::format("set logscale x {}\n", x_base);
  if (plot.log_y) text += fmt::format("set logscale y {}\n", plot.ideal_line ? x_base : 10);
  return text;
}

namespace {

// Chooses the step between ticks: the smallest of 1, 2 or 5 times a power of ten that fits at most
// `most` times.
double choose_step(double length, double most) {
  const double least = length / most, power = std::pow(10, std::floor(std::log10(least)));
  for (const double factor : {1, 2, 5})
    if (factor * power >= least) return factor * power;
  return 10 * power;
}

// The number of letters of the longest number on an axis.
std::size_t count_letters(const Extent& range, bool is_log) {
  std::size_t letters = 1;
  const auto measure = [&](double tick) {
    letters = std::max(letters, fmt::format("{:g}", tick).size());
  };
  if (is_log)
    for (double power = std::floor(std::log10(range.low)); power <= std::log10(range.high); ++power)
      measure(std::pow(10, power));
  if (is_log || !(range.high > range.low)) return letters;
  constexpr int INTERVALS = 8;
  const double step = choose_step(range.high - range.low, INTERVALS);
  for (int i = 0; i <= INTERVALS + 1; ++i) measure((std::floor(range.low / step) + i) * step);
  return letters;
}

// The ends of the x axis.
Extent find_x_ends(const Plot& plot, const Extent& x) {
  const double ratio = x.high > x.low && plot.log_x ? std::pow(x.high / x.low, 0.04) : 1.5;
  const double margin = x.high > x.low ? 0.04 * (x.high - x.low) : 0.5;
  return plot.log_x ? Extent{x.low / ratio, x.high * ratio}
                    : Extent{x.low - margin, x.high + margin};
}

}  // namespace

std::vector<std::string> break_y_label(const std::string& label, double height,
                                       const PlotSize& size) {
  return break_label(label, static_cast<std::size_t>(height / size.width_of(1)));
}

Margins find_margins(const Plot& plot, const Axes& axes, const PlotSize& size) {
  auto range = axes.y;
  if (plot.y_min && !plot.log_y) range.add(*plot.y_min);
  auto letters = count_letters(range, plot.log_y);
  if (!plot.differences.empty()) letters = std::max(letters, count_letters(axes.difference, false));
  const auto lines = break_y_label(plot.y_label, size.upper, size).size();
  const double left =
      size.scale(26) * static_cast<double>(lines) + size.width_of(letters) + size.scale(24);
  const double last = size.width_of(fmt::format("{:g}", axes.x.high).size());
  return {left, std::max(0.025 * size.width, 0.5 * last)};
}

double find_x_length(const Plot& plot, const Axes& axes, const PlotSize& size) {
  const auto margins = find_margins(plot, axes, size);
  return size.width - margins.left - margins.right;
}

std::string make_x_range(const Plot& plot, const Extent& x) {
  const auto ends = find_x_ends(plot, x);
  return fmt::format("set xrange [{}:{}]\n", ends.low, ends.high);
}

// Lists 1, 2 and 5 times the powers of ten, for ranges of at most two and a half decades. Powers of
// ten alone would be too few.
std::vector<double> list_log_ticks(double low, double high) {
  if (high > 300 * low) return {};
  std::vector<double> ticks;
  for (double power = std::pow(10, std::floor(std::log10(low))); power <= high; power *= 10)
    for (const double factor : {1, 2, 5})
      if (const double tick = factor * power; tick >= low && tick <= high) ticks.push_back(tick);
  return ticks;
}

// Makes the ticks of x. A logarithmic scale with few points has a tick at each point; a short
// linear scale of integers has a tick at each integer if there is room. `labelled` is false for an
// upper panel, since the numbers are below the lower panel.
std::string make_x_ticks(const Plot& plot, const Axes& axes, const PlotSize& size, bool labelled) {
  if (plot.log_x && axes.marks.size() <= 12) {
    const auto ends = find_x_ends(plot, axes.x);
    std::vector<double> marks{axes.marks.begin(), axes.marks.end()};
    if (marks.empty()) marks = list_log_ticks(ends.low, ends.high);
    if (marks.empty()) return "";
    std::vector<std::string> ticks;
    for (const auto& [at, text] :
         label_log_ticks(marks, ends.low, ends.high, find_x_length(plot, axes, size), size))
      ticks.push_back(fmt::format("'{}' {}", labelled ? text : "", at));
    return fmt::format("set xtics ({})\n", join_texts(ticks, ", "));
  }
  const bool are_integers = !axes.marks.empty() && std::ranges::all_of(axes.marks, [](double mark) {
    return mark == std::floor(mark);
  });
  const double length = axes.x.high - axes.x.low;
  const auto letters = fmt::format("{:g}", axes.x.high).size();
  const double most = find_x_length(plot, axes, size) / (size.width_of(letters) + size.font);
  if (are_integers && !plot.log_x && length <= 20)
    return fmt::format("set xtics {}\n", std::max(1.0, choose_step(length, most)));
  return plot.log_x || length <= 0
             ? ""
             : fmt::format("set xtics {}\n", choose_step(length, std::min(most, 10.0)));
}

namespace {

// Limits y if the ideal line lies far above the points, since they would otherwise look flat.
std::string make_linear_y_range(const Plot& plot, const Axes& axes) {
  const Extent &x = axes.x, &y = axes.y;
  std::string low = "*", high = "*";
  if (plot.y_min) low = fmt::format("{}", *plot.y_min);
  if (plot.y_max) high = fmt::format("{}", *plot.y_max);
  if (plot.ideal_line && !plot.y_max && x.high > 2.5 * y.high && y.high > 0)
    high = fmt::format("{}", 1.5 * y.high);
  return fmt::format("set yrange [{}:{}]\n", low, high);
}

std::string make_log_y_ticks(double low, double high) {
  std::vector<std::string> ticks;
  for (const double tick : list_log_ticks(low, high))
    ticks.push_back(fmt::format("'{0:.6g}' {0:.6g}", tick));
  if (ticks.empty()) return {};
  return fmt::format("set ytics ({})\n", join_texts(ticks, ", "));
}

}  // namespace

std::string make_y_range(const Plot& plot, const Axes& axes) {
  if (!plot.log_y) return make_linear_y_range(plot, axes);
  const Extent &x = axes.x, &y = axes.y;
  const double margin = std::max(1.1, std::pow(y.high / y.low, 0.06));
  const double low = plot.y_min && *plot.y_min > 0 ? *plot.y_min : y.low / margin;
  double high = plot.y_max.value_or(y.high * margin);
  if (plot.ideal_line && !plot.y_max) high = std::max(high, std::min(x.high, 2 * y.high));
  return fmt::format("set yrange [{}:{}]\n", low, high) +
         (axes.is_doubling && plot.ideal_line ? "" : make_log_y_ticks(low, high));
}

// The y range of the lower panel. It includes 0, and has a margin of at least half a percent.
std::string make_difference_range(const Extent& difference) {
  const double margin = std::max(0.1 * (difference.high - difference.low), 0.5);
  const double low = std::min(0.0, difference.low) - margin;
  const double high = std::max(0.0, difference.high) + margin;
  return fmt::format("set yrange [{}:{}]\nset ytics {}\n", low, high, choose_step(high - low, 5));
}

namespace {}  // namespace

}  // namespace laboratory

#include "experiments/laboratory/report/gnuplot_axes.hpp"

#include <fmt/format.h>

#include <set>

#include "experiments/laboratory/report/gnuplot_curves.hpp"

namespace laboratory {
namespace {

bool is_power_of_two(double value) {
  return value > 0 && std::exp2(std::round(std::log2(value))) == value;
}

// The x of every point.
std::set<double> all_x(const Plot& plot) {
  std::set<double> values;
  for (const auto& s : plot.series)
    for (std::size_t i = 0; i < s.x.size(); ++i)
      if (s.kind != SeriesKind::law && is_drawn(plot, s.x[i], s.y[i])) values.insert(s.x[i]);
  return values;
}

bool is_doubling(const Plot& plot) {
  return plot.log_x && std::ranges::all_of(all_x(plot), is_power_of_two);
}

// An ideal far above the points would press them together: it may leave the picture.
std::string make_linear_y_range(const Plot& plot, const Extent& x, const Extent& y) {
  std::string low = "*", high = "*";
  if (plot.y_min) low = fmt::format("{}", *plot.y_min);
  if (plot.y_max) high = fmt::format("{}", *plot.y_max);
  if (plot.ideal_line && !plot.y_max && x.high > 2.5 * y.high && y.high > 0)
    high = fmt::format("{}", 1.5 * y.high);
  return fmt::format("set yrange [{}:{}]\n", low, high);
}

// Where a decade or two are shown, powers of ten alone would say little.
std::string make_log_ticks(double low, double high) {
  if (high > 300 * low) return {};
  std::vector<std::string> ticks;
  for (double power = std::pow(10, std::floor(std::log10(low))); power <= high; power *= 10)
    for (const double factor : {1, 2, 5})
      if (const double tick = factor * power; tick >= low && tick <= high)
        ticks.push_back(fmt::format("'{0:.6g}' {0:.6g}", tick));
  if (ticks.empty()) return {};
  return fmt::format("set ytics ({})\n", join_texts(ticks, ", "));
}

// 1, 2 or 5 times a power of ten, such that at most `most` steps go into a length.
double choose_step(double length, double most) {
  const double least = length / most, power = std::pow(10, std::floor(std::log10(least)));
  for (const double factor : {1, 2, 5})
    if (factor * power >= least) return factor * power;
  return 10 * power;
}

}  // namespace

std::string make_scales(const Plot& plot) {
  const bool doubles = is_doubling(plot);
  std::string text;
  if (plot.log_x) text += fmt::format("set logscale x {}\n", doubles ? 2 : 10);
  if (plot.log_y) text += fmt::format("set logscale y {}\n", doubles && plot.ideal_line ? 2 : 10);
  return text;
}

std::string make_x_range(const Plot& plot, const Extent& x) {
  const double ratio = x.high > x.low && plot.log_x ? std::pow(x.high / x.low, 0.04) : 1.5;
  const double margin = x.high > x.low ? 0.04 * (x.high - x.low) : 0.5;
  return fmt::format("set xrange [{}:{}]\n", plot.log_x ? x.low / ratio : x.low - margin,
                     plot.log_x ? x.high * ratio : x.high + margin);
}

std::string make_x_ticks(const Plot& plot, const Extent& x, bool labelled) {
  const auto values = all_x(plot);
  const bool are_integers =
      std::ranges::all_of(values, [](double v) { return v == std::floor(v); });
  if (plot.log_x && values.size() <= 12) {
    std::vector<std::string> ticks;
    for (const double value : values)
      ticks.push_back(fmt::format("'{}' {}", labelled ? fmt::format("{:g}", value) : "", value));
    return fmt::format("set xtics ({})\n", join_texts(ticks, ", "));
  }
  if (are_integers && !plot.log_x && x.high - x.low <= 20) return "set xtics 1\n";
  return "";
}

std::string make_y_range(const Plot& plot, const Extent& x, const Extent& y) {
  if (!plot.log_y) return make_linear_y_range(plot, x, y);
  const double margin = std::max(1.1, std::pow(y.high / y.low, 0.06));
  const double low = plot.y_min && *plot.y_min > 0 ? *plot.y_min : y.low / margin;
  double high = plot.y_max.value_or(y.high * margin);
  if (plot.ideal_line && !plot.y_max) high = std::max(high, std::min(x.high, 2 * y.high));
  return fmt::format("set yrange [{}:{}]\n", low, high) +
         (is_doubling(plot) && plot.ideal_line ? "" : make_log_ticks(low, high));
}

// Room for the curves even where all are 0: a percent at least.
std::string make_difference_range(const Extent& difference) {
  const double margin = std::max(0.1 * (difference.high - difference.low), 0.5);
  const double low = std::min(0.0, difference.low) - margin;
  const double high = std::max(0.0, difference.high) + margin;
  return fmt::format("set yrange [{}:{}]\nset ytics {}\n", low, high, choose_step(high - low, 5));
}

}  // namespace laboratory

#include "experiments/laboratory/report/plot_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <kainjow/mustache.hpp>
#include <set>
#include <stdexcept>

#include "experiments/laboratory/report/report_files.hpp"

namespace laboratory {
namespace {

namespace mustache = kainjow::mustache;

struct Dot {
  double x, y;
};

// The points of a series that can be drawn; on a logarithmic scale these are the positive ones.
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

std::vector<Dot> upper_points(const Plot& plot, const Series& series) {
  return drawn_points(plot, series, plot.log_y);
}

// The points of a series in the lower panel, whose y scale is always linear.
std::vector<Dot> lower_points(const Plot& plot, const Series& series) {
  return drawn_points(plot, series, false);
}

// Formats the band of a curve as lines of x, low and high. Skips points that cannot be drawn.
std::string make_band(const Plot& plot, const Series& s) {
  std::string text;
  for (std::size_t i = 0; i < s.low.size(); ++i)
    if ((!plot.log_x || s.x[i] > 0) && (!plot.log_y || s.low[i] > 0))
      text += fmt::format("{} {} {}\n", s.x[i], s.low[i], s.high[i]);
  return text;
}

// Formats the error bars of a curve as lines of x, y, low and high. Omits points whose interval has
// no width. A bar that would reach 0 on a logarithmic scale ends at the point instead.
std::string make_bars(const Plot& plot, const Series& s) {
  std::string text;
  for (std::size_t i = 0; i < s.low.size(); ++i) {
    if ((plot.log_x && s.x[i] <= 0) || (plot.log_y && s.y[i] <= 0) || s.low[i] == s.high[i])
      continue;
    const double low = plot.log_y && s.low[i] <= 0 ? s.y[i] : s.low[i];
    text += fmt::format("{} {} {} {}\n", s.x[i], s.y[i], low, s.high[i]);
  }
  return text;
}

// Makes a named data block of gnuplot, such as $data0.
std::string make_data_block(const std::string& name, const std::vector<Dot>& points) {
  auto text = fmt::format("${} << END\n", name);
  for (const auto& point : points) text += fmt::format("{} {}\n", point.x, point.y);
  return text + "END\n";
}

struct Extent {
  double low = INFINITY, high = -INFINITY;
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

// The ranges of the points, from which the plot's axes are chosen.
struct Axes {
  Extent x, y, difference;
  std::set<double> marks;    // x of all points of the upper panel, except points of laws
  bool is_doubling = false;  // true if the x scale is logarithmic and its ticks are powers of two
};

bool is_power_of_two(double value) {
  return value > 0 && std::exp2(std::round(std::log2(value))) == value;
}

Axes measure_axes(const Plot& plot) {
  Axes axes;
  for (const auto& series : plot.series)
    for (const auto& point : upper_points(plot, series)) {
      axes.x.add(point.x);
      axes.y.add(point.y);
      if (series.kind != SeriesKind::law) axes.marks.insert(point.x);
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
  axes.is_doubling = plot.log_x && std::ranges::all_of(axes.marks, is_power_of_two);
  return axes;
}

// Sets logarithmic scales. The base for x is 2 if its ticks are powers of two; if there is an ideal
// line, y has the same base. Otherwise the base is 10.
std::string make_scales(const Plot& plot, const Axes& axes) {
  const int x_base = axes.is_doubling ? 2 : 10;
  std::string text;
  if (plot.log_x) text += fmt::format("set logscale x {}\n", x_base);
  if (plot.log_y) text += fmt::format("set logscale y {}\n", plot.ideal_line ? x_base : 10);
  return text;
}

std::string make_x_range(const Plot& plot, const Extent& x) {
  const double ratio = x.high > x.low && plot.log_x ? std::pow(x.high / x.low, 0.04) : 1.5;
  const double margin = x.high > x.low ? 0.04 * (x.high - x.low) : 0.5;
  return fmt::format("set xrange [{}:{}]\n", plot.log_x ? x.low / ratio : x.low - margin,
                     plot.log_x ? x.high * ratio : x.high + margin);
}

// Makes the ticks of x. A logarithmic scale with few points has a tick at each point; a short
// linear scale with integers has a tick at each integer. `labelled` is false for the upper one of
// two panels, because the numbers are below the lower panel.
std::string make_x_ticks(const Plot& plot, const Axes& axes, bool labelled) {
  if (plot.log_x && axes.marks.size() <= 12) {
    std::vector<std::string> ticks;
    for (const double mark : axes.marks)
      ticks.push_back(fmt::format("'{}' {}", labelled ? fmt::format("{:g}", mark) : "", mark));
    return fmt::format("set xtics ({})\n", join_texts(ticks, ", "));
  }
  const bool are_integers =
      std::ranges::all_of(axes.marks, [](double mark) { return mark == std::floor(mark); });
  if (are_integers && !plot.log_x && axes.x.high - axes.x.low <= 20) return "set xtics 1\n";
  return "";
}

// Limits the y axis if the ideal line lies far above the points, because the curves would look flat
// otherwise.
std::string make_linear_y_range(const Plot& plot, const Axes& axes) {
  const Extent &x = axes.x, &y = axes.y;
  std::string low = "*", high = "*";
  if (plot.y_min) low = fmt::format("{}", *plot.y_min);
  if (plot.y_max) high = fmt::format("{}", *plot.y_max);
  if (plot.ideal_line && !plot.y_max && x.high > 2.5 * y.high && y.high > 0)
    high = fmt::format("{}", 1.5 * y.high);
  return fmt::format("set yrange [{}:{}]\n", low, high);
}

// Makes ticks at 1, 2 and 5 times each power of ten, if the largest value is at most 300 times the
// smallest. Powers of ten alone would be too few ticks then.
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

std::string make_y_range(const Plot& plot, const Axes& axes) {
  if (!plot.log_y) return make_linear_y_range(plot, axes);
  const Extent &x = axes.x, &y = axes.y;
  const double margin = std::max(1.1, std::pow(y.high / y.low, 0.06));
  const double low = plot.y_min && *plot.y_min > 0 ? *plot.y_min : y.low / margin;
  double high = plot.y_max.value_or(y.high * margin);
  if (plot.ideal_line && !plot.y_max) high = std::max(high, std::min(x.high, 2 * y.high));
  return fmt::format("set yrange [{}:{}]\n", low, high) +
         (axes.is_doubling && plot.ideal_line ? "" : make_log_ticks(low, high));
}

// Chooses the distance of ticks on an axis of this length: the smallest of 1, 2 or 5 times a power
// of ten that fits at most `most` times.
double choose_step(double length, double most) {
  const double least = length / most, power = std::pow(10, std::floor(std::log10(least)));
  for (const double factor : {1, 2, 5})
    if (factor * power >= least) return factor * power;
  return 10 * power;
}

// Sets the y range of the lower panel. It includes 0, and has a margin of at least half a percent.
std::string make_difference_range(const Extent& difference) {
  const double margin = std::max(0.1 * (difference.high - difference.low), 0.5);
  const double low = std::min(0.0, difference.low) - margin;
  const double high = std::max(0.0, difference.high) + margin;
  return fmt::format("set yrange [{}:{}]\nset ytics {}\n", low, high, choose_step(high - low, 5));
}

// Okabe and Ito's colours, which colour-blind readers can distinguish, the darkest first. Without
// yellow, which is invisible on white.
constexpr const char* COLOURS[] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                   "#E69F00", "#56B4E9", "#000000"};
// gnuplot's numbers for the symbols that Look::symbol lists.
constexpr int FILLED[] = {7, 5, 9, 13, 11, 15, 2, 1, 3};
constexpr int OPEN[] = {6, 4, 8, 12, 10, 14, 2, 1, 3};
constexpr const char* DASHES[] = {"", "12,6", "3,5", "12,5,3,5", "12,4,3,4,3,4"};

std::string make_style(SeriesKind kind, std::size_t look) {
  const auto [code, gaps, shape] = look_of(look);
  const auto colour = fmt::format("linecolor rgb '{}'", code);
  const std::string dashes = *gaps ? fmt::format("({})", gaps) : "solid";
  switch (kind) {
    case SeriesKind::curve:
      return fmt::format("with linespoints {} linewidth 2 dashtype {} pointtype {} pointsize 1",
                         colour, dashes, FILLED[shape]);
    case SeriesKind::reference:
      return fmt::format("with points {} linewidth 2 pointtype {} pointsize 1.5", colour,
                         OPEN[shape]);
    case SeriesKind::law:
      return fmt::format("with lines {} linewidth 1 dashtype solid", colour);
    case SeriesKind::mark:
      break;
  }
  return "with points linecolor rgb '#000000' linewidth 1.5 pointtype 6 pointsize 2.4";
}

// The parts of gnuplot's command `plot` for one panel, and the data blocks that they use.
struct Panel {
  std::vector<std::string> curves;
  std::string data;

  void add(const std::string& name, const std::vector<Dot>& points, const std::string& style,
           const std::string& title) {
    if (points.empty()) return;
    data += make_data_block(name, points);
    curves.push_back(fmt::format("${} {} {}", name, style, title));
  }
  std::string join() const { return join_texts(curves, ", \\\n     "); }
};

// Adds error bars, which lie behind the symbols of their curve. Point type 0 draws no symbol.
void add_bars(Panel& panel, std::size_t series, const std::string& bars, const Look& look) {
  if (bars.empty()) return;
  panel.data += fmt::format("$bars{} << END\n{}END\n", series, bars);
  panel.curves.push_back(fmt::format(
      "$bars{} with yerrorbars linecolor rgb '{}' linewidth 1.5 dashtype solid pointtype 0 "
      "pointsize 0 notitle",
      series, look.colour));
}

Panel make_upper(const Plot& plot) {
  Panel panel;
  if (plot.ideal_line)
    panel.curves.push_back(
        "x with lines linecolor rgb '#707070' linewidth 1.5 dashtype (18,9) title 'ideal'");
  if (plot.level)
    panel.curves.push_back(
        fmt::format("{} with lines linecolor rgb '#707070' linewidth 1.5 dashtype (18,9) notitle",
                    *plot.level));
  std::size_t banded = 0;  // number of curves; bands and error bars are drawn behind them
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const Series& s = plot.series[i];
    if (s.kind != SeriesKind::curve) continue;
    const auto look = look_of(banded++);
    if (s.has_bars) {
      add_bars(panel, i, make_bars(plot, s), look);
      continue;
    }
    const auto edges = make_band(plot, s);
    if (edges.empty()) continue;
    panel.data += fmt::format("$band{} << END\n{}END\n", i, edges);
    panel.curves.push_back(
        fmt::format("$band{} with filledcurves linecolor rgb '{}' fillstyle transparent solid 0.18 "
                    "noborder notitle",
                    i, look.colour));
  }
  std::size_t curve = 0;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const Series& s = plot.series[i];
    const auto look = s.kind == SeriesKind::curve ? curve++ : s.of;
    panel.add(fmt::format("data{}", i), upper_points(plot, s), make_style(s.kind, look),
              s.name.empty() ? "notitle" : "title " + quote_for_gnuplot(s.key()));
  }
  return panel;
}

Panel make_lower(const Plot& plot) {
  Panel panel;
  panel.curves.push_back("0 with lines linecolor rgb '#707070' linewidth 1 dashtype solid notitle");
  for (std::size_t i = 0; i < plot.differences.size(); ++i) {
    const Series& s = plot.differences[i];
    panel.add(fmt::format("difference{}", i), lower_points(plot, s),
              make_style(SeriesKind::curve, s.of), "notitle");
  }
  return panel;
}

// Heights in pixels of the parts of a drawing that is 800 pixels wide, from the bottom: the legend,
// x label and numbers, the lower panel with a gap above it, the upper panel, the title.
constexpr int KEY_MARGIN = 8, KEY_LINE = 21, BELOW = 62, LOWER = 130, GAP = 16, UPPER = 325,
              ABOVE = 50;

// Layout of the legend. It has no more columns than gnuplot itself would choose, so that the number
// of its lines is known in advance.
struct Key {
  int lines = 0, columns = 1;
};

Key arrange_key(const Plot& plot) {
  std::size_t entries = plot.ideal_line ? 1 : 0, longest = 5;
  for (const auto& series : plot.series) {
    entries += !series.name.empty();
    longest = std::max(longest, width_of(series.key()));
  }
  const auto columns = std::max<std::size_t>(1, 700 / (90 + 10 * longest));
  const auto lines = (entries + columns - 1) / columns;
  return {static_cast<int>(lines), static_cast<int>(columns)};
}

// Chooses the font size of the title so that the title fits.
std::string choose_title_size(const std::string& title) {
  // largest font size in points, and number of characters that fit in that size
  constexpr double LARGEST = 17, FITS = 58;
  const double size = std::min(LARGEST, LARGEST * FITS / static_cast<double>(title.size() + 1));
  return fmt::format("{:.3g}", size);
}

}  // namespace

Look look_of(std::size_t curve) {
  return {COLOURS[curve % std::size(COLOURS)], DASHES[curve % std::size(DASHES)],
          curve % std::size(FILLED)};
}

// Uses double quotes, because gnuplot misreads a single quote at the start of a text in single
// quotes.
std::string quote_for_gnuplot(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') quoted += fmt::format("\\{}", c);
    // escapes characters by which gnuplot runs a command (`) or expands a macro (@)
    else if (c == '`' || c == '@')
      quoted += fmt::format("\\{:o}", code);
    else
      quoted += code < 0x20 || code == 0x7f ? ' ' : c;
  }
  return quoted + "\"";
}

bool has_points(const Plot& plot) {
  return std::ranges::any_of(
      plot.series, [&](const Series& series) { return !upper_points(plot, series).empty(); });
}

int choose_height(const Plot& plot) {
  const int key = KEY_MARGIN + KEY_LINE * arrange_key(plot).lines;
  return key + BELOW + (plot.differences.empty() ? 0 : LOWER + GAP) + UPPER + ABOVE;
}

std::string make_gnuplot_script(const Plot& plot) {
  if (!has_points(plot))
    throw std::invalid_argument(fmt::format("plot {}: no points to draw", plot.name));
  const Axes axes = measure_axes(plot);
  const Panel upper = make_upper(plot), lower = make_lower(plot);
  // distance of the upper panel from the lower edge of the drawing, pixels
  const int bottom = choose_height(plot) - ABOVE - UPPER;
  const Key key = arrange_key(plot);
  const auto edge = [&](int pixels) {
    return fmt::format("{:.4f}", pixels / static_cast<double>(choose_height(plot)));
  };
  mustache::object page = {{"data", upper.data + lower.data},
                           {"scales", make_scales(plot, axes)},
                           {"x_range", make_x_range(plot, axes.x)},
                           {"x_ticks", make_x_ticks(plot, axes, true)},
                           {"title", quote_for_gnuplot(plot.title)},
                           {"title_size", choose_title_size(plot.title)},
                           {"key_top", edge(KEY_MARGIN + KEY_LINE * key.lines)},
                           {"key_columns", std::to_string(key.columns)},
                           {"x_label", quote_for_gnuplot(plot.x_label)},
                           {"y_label", quote_for_gnuplot(plot.y_label)},
                           {"y_range", make_y_range(plot, axes)},
                           {"bottom", edge(bottom)},
                           {"top", edge(bottom + UPPER)},
                           {"curves", upper.join()},
                           {"lower", !plot.differences.empty()},
                           {"x_marks", make_x_ticks(plot, axes, false)},
                           {"lower_label", quote_for_gnuplot(plot.difference_label)},
                           {"lower_range", make_difference_range(axes.difference)},
                           {"lower_bottom", edge(bottom - GAP - LOWER)},
                           {"lower_top", edge(bottom - GAP)},
                           {"lower_curves", lower.join()}};
  mustache::mustache script(PLOT_TEMPLATE);
  script.set_custom_escape([](const std::string& text) { return text; });
  return script.render(page);
}

}  // namespace laboratory

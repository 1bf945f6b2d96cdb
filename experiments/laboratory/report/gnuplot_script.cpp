// A plot in gnuplot's language: where everything is.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "experiments/laboratory/report/gnuplot.hpp"
#include "experiments/laboratory/report/gnuplot_axes.hpp"
#include "experiments/laboratory/report/gnuplot_curves.hpp"
#include "experiments/laboratory/report/plot.hpp"

namespace laboratory {
namespace {

// Points; a long title is smaller, lest it be cut off.
double title_size(const std::string& title) {
  constexpr double LARGEST = 17, FITS = 58;  // characters of the largest size
  return std::min(LARGEST, LARGEST * FITS / static_cast<double>(title.size() + 1));
}

// Heights in pixels of a drawing 800 wide, from the bottom: key, x label and numbers, lower panel
// with the gap above it, upper panel, title.
constexpr int KEY_MARGIN = 8, KEY_LINE = 21, BELOW = 62, LOWER = 130, GAP = 16, UPPER = 325,
              ABOVE = 50;

std::size_t count_characters(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](unsigned char c) { return (c & 0xc0) != 0x80; }));
}

// Not more columns than gnuplot makes by itself, so that lines of the key can be counted.
struct Key {
  int lines = 0, columns = 1;
};

Key arrange_key(const Plot& plot) {
  std::size_t entries = plot.ideal_line ? 1 : 0, longest = 5;
  for (const auto& series : plot.series) {
    entries += !series.name.empty();
    longest = std::max(longest, count_characters(series.name));
  }
  const auto columns = std::max<std::size_t>(1, 700 / (90 + 10 * longest));
  const auto lines = (entries + columns - 1) / columns;
  return {static_cast<int>(lines), static_cast<int>(columns)};
}

// One data block for each series; the number of points in it that are drawn.
std::size_t add_data(std::string& text, const Plot& plot, const Series& s, const std::string& name,
                     bool with_log_y, Extent& x, Extent& y) {
  if (s.x.size() != s.y.size())
    throw std::invalid_argument(fmt::format("plot {}: the series \"{}\" has {} x but {} y",
                                            plot.name, s.name, s.x.size(), s.y.size()));
  std::size_t points = 0;
  text += fmt::format("${} << END\n", name);
  for (std::size_t k = 0; k < s.x.size(); ++k) {
    if (!is_drawn(plot, s.x[k], with_log_y ? s.y[k] : 1) || !std::isfinite(s.y[k])) continue;
    text += fmt::format("{} {}\n", s.x[k], s.y[k]);
    x.add(s.x[k]);
    y.add(s.y[k]);
    ++points;
  }
  text += "END\n";
  return points;
}

std::string make_data(const Plot& plot, Extent& x, Extent& y, Extent& difference) {
  std::string text;
  std::size_t points = 0;
  for (std::size_t i = 0; i < plot.series.size(); ++i)
    points += add_data(text, plot, plot.series[i], fmt::format("data{}", i), true, x, y);
  if (points == 0)
    throw std::invalid_argument(fmt::format("plot {}: no points to draw", plot.name));
  for (std::size_t i = 0; i < plot.differences.size(); ++i)
    add_data(text, plot, plot.differences[i], fmt::format("difference{}", i), false, x, difference);
  return text;
}

std::string make_margins(const Plot& plot, int bottom, int top) {
  const double height = choose_height(plot);
  return fmt::format("set bmargin at screen {:.4f}\nset tmargin at screen {:.4f}\n",
                     bottom / height, top / height);
}

std::string make_look(const Plot& plot, const Extent& x) {
  return "set border 3 linecolor rgb '#404040'\nset tics nomirror out scale 0.6\n"
         "set format '%h'\nset xtics offset 0,0.2\nset grid linetype 1 linecolor rgb '#d8d8d8' "
         "linewidth 0.8\nset rmargin at screen 0.975\n" +
         make_scales(plot) + make_x_range(plot, x) + make_x_ticks(plot, x);
}

}  // namespace

bool has_points(const Plot& plot) {
  Extent x, y;
  std::string unused;
  return std::ranges::any_of(plot.series, [&](const Series& series) {
    return add_data(unused, plot, series, "data", true, x, y) > 0;
  });
}

int choose_height(const Plot& plot) {
  const int key = KEY_MARGIN + KEY_LINE * arrange_key(plot).lines;
  return key + BELOW + (plot.differences.empty() ? 0 : LOWER + GAP) + UPPER + ABOVE;
}

std::string make_gnuplot_script(const Plot& plot) {
  Extent x, y, difference;
  const auto data = make_data(plot, x, y, difference);
  const double height = choose_height(plot);
  const int axis = choose_height(plot) - ABOVE - UPPER;  // of the upper panel's numbers
  const bool has_lower = !plot.differences.empty();
  const auto x_label = fmt::format("set xlabel {} offset 0,0.6\n", quote_for_gnuplot(plot.x_label));

  std::string text = "reset\nset encoding utf8\nset samples 400\n" + data + make_look(plot, x);
  text += fmt::format("set title {} font ',{:.3g}' offset 0,-0.3\n", quote_for_gnuplot(plot.title),
                      title_size(plot.title));
  const Key key = arrange_key(plot);
  text += fmt::format(
      "set key at screen 0.535,{:.4f} center top horizontal Left reverse samplen 4 maxcols {} "
      "noenhanced\n",
      (KEY_MARGIN + KEY_LINE * key.lines) / height, key.columns);
  text += fmt::format("set ylabel {}\n", quote_for_gnuplot(plot.y_label));
  text += make_y_range(plot, x, y);
  if (has_lower)
    text += "set multiplot\nset lmargin at screen 0.13\nset format x ''\n" +
            make_x_ticks(plot, x, false);
  else
    text += x_label;
  text += make_margins(plot, axis, axis + UPPER) + "plot " + make_curves(plot) + "\n";
  if (!has_lower) return text;
  text += "unset title\nunset key\nset format x '%h'\nunset logscale y\n" + x_label +
          make_x_ticks(plot, x);
  text += fmt::format("set ylabel {}\n", quote_for_gnuplot(plot.difference_label));
  text += make_difference_range(difference);
  text += make_margins(plot, axis - GAP - LOWER, axis - GAP);
  return text + "plot " + make_difference_curves(plot) + "\nunset multiplot\n";
}

}  // namespace laboratory

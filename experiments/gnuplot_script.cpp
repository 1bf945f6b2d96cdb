// A plot in gnuplot's language: how it looks.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "experiments/gnuplot.hpp"
#include "experiments/plot.hpp"

namespace experiments {
namespace {

// Okabe and Ito's colours, which colour-blind readers tell apart, without the yellow that white
// paper swallows; darkest first. 7 colours and 5 dashes: 35 different lines.
constexpr const char* COLOURS[] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                   "#E69F00", "#56B4E9", "#000000"};
constexpr int FILLED[] = {7, 5, 9, 13, 11};  // disc, square, triangles, diamond
constexpr int OPEN[] = {6, 4, 8, 12, 10};
constexpr const char* DASHES[] = {"solid", "(12,6)", "(3,5)", "(12,5,3,5)", "(12,4,3,4,3,4)"};

struct Extent {
  double low = INFINITY, high = -INFINITY;
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

bool is_drawn(const Plot& plot, double x, double y) {
  return std::isfinite(x) && std::isfinite(y) && (!plot.log_x || x > 0) && (!plot.log_y || y > 0);
}

bool is_word_character(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '.'; }

// "3200 objects, thesis" contains the words "3200 objects" but not "200 objects".
bool contains_words(const std::string& text, const std::string& words) {
  if (words.empty()) return false;
  for (auto at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) {
    const auto end = at + words.size();
    const bool begins = at == 0 || !is_word_character(text[at - 1]);
    if (begins && (end == text.size() || !is_word_character(text[end]))) return true;
  }
  return false;
}

// Which of the looks each series wears.
std::vector<std::size_t> choose_looks(const Plot& plot) {
  std::vector<std::size_t> own, looks;
  for (std::size_t i = 0; i < plot.series.size(); ++i)
    if (!plot.series[i].is_reference) own.push_back(i);
  std::size_t measured = 0, references = 0;
  for (const auto& series : plot.series) {
    if (!series.is_reference) {
      looks.push_back(measured++);
      continue;
    }
    std::size_t look = references++;
    std::size_t longest = 0;
    for (std::size_t k = 0; k < own.size(); ++k) {
      const auto& name = plot.series[own[k]].name;
      if (name.size() > longest && contains_words(series.name, name))
        look = k, longest = name.size();
    }
    looks.push_back(look);
  }
  return looks;
}

// Integers get integer ticks; few, or on a logarithmic scale, exactly those that have points.
std::string make_x_ticks(const Plot& plot, const Extent& x) {
  std::set<double> values;
  for (const auto& series : plot.series)
    for (std::size_t i = 0; i < series.x.size(); ++i)
      if (is_drawn(plot, series.x[i], series.y[i])) values.insert(series.x[i]);
  const bool are_integers =
      std::ranges::all_of(values, [](double v) { return v == std::floor(v); });
  if (plot.log_x && values.size() <= 12) {
    std::vector<std::string> ticks;
    for (const double value : values) ticks.push_back(fmt::format("'{:g}' {}", value, value));
    return fmt::format("set xtics ({})\n", join_texts(ticks, ", "));
  }
  if (are_integers && !plot.log_x && x.high - x.low <= 20) return "set xtics 1\n";
  return "";
}

std::string make_ranges(const Plot& plot, const Extent& x, const Extent& y) {
  std::string text;
  const double ratio = x.high > x.low && plot.log_x ? std::pow(x.high / x.low, 0.04) : 1.5;
  const double margin = x.high > x.low ? 0.04 * (x.high - x.low) : 0.5;
  const double left = plot.log_x ? x.low / ratio : x.low - margin;
  const double right = plot.log_x ? x.high * ratio : x.high + margin;
  text += fmt::format("set xrange [{}:{}]\n", left, right);
  if (plot.log_x) text += "set logscale x\n";
  if (plot.log_y) text += "set logscale y\n";

  std::string low = "*", high = "*";
  if (plot.y_min && (!plot.log_y || *plot.y_min > 0)) low = fmt::format("{}", *plot.y_min);
  if (plot.y_max) high = fmt::format("{}", *plot.y_max);
  // An ideal far above the points would press them together: it may leave the picture.
  if (plot.ideal_line && !plot.y_max && right > 2.5 * y.high && y.high > 0)
    high = fmt::format("{}", 1.5 * y.high);
  text += fmt::format("set yrange [{}:{}]\n", low, high);
  return text;
}

std::string make_data(const Plot& plot, Extent& x, Extent& y) {
  std::string text;
  std::size_t points = 0;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const Series& s = plot.series[i];
    if (s.x.size() != s.y.size())
      throw std::invalid_argument(fmt::format("plot {}: the series \"{}\" has {} x but {} y",
                                              plot.name, s.name, s.x.size(), s.y.size()));
    text += fmt::format("$data{} << END\n", i);
    for (std::size_t k = 0; k < s.x.size(); ++k) {
      if (!is_drawn(plot, s.x[k], s.y[k])) continue;
      text += fmt::format("{} {}\n", s.x[k], s.y[k]);
      x.add(s.x[k]);
      y.add(s.y[k]);
      ++points;
    }
    text += "END\n";
  }
  if (points == 0)
    throw std::invalid_argument(fmt::format("plot {}: no points to draw", plot.name));
  return text;
}

std::string make_curves(const Plot& plot) {
  std::vector<std::string> curves;
  if (plot.ideal_line)
    curves.push_back(
        "x with lines linecolor rgb '#707070' linewidth 1.5 dashtype (18,9) title "
        "'ideal'");
  const auto looks = choose_looks(plot);
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const Series& s = plot.series[i];
    const bool is_empty = std::ranges::none_of(
        s.x, [&, k = std::size_t{0}](double x) mutable { return is_drawn(plot, x, s.y[k++]); });
    if (is_empty) continue;
    const auto colour = COLOURS[looks[i] % std::size(COLOURS)];
    const auto shape = looks[i] % std::size(FILLED);
    const auto title = s.name.empty() ? "notitle" : "title " + quote_for_gnuplot(s.name);
    curves.push_back(
        s.is_reference
            ? fmt::format("$data{} with points linecolor rgb '{}' linewidth 2 pointtype {} "
                          "pointsize 1.5 {}",
                          i, colour, OPEN[shape], title)
            : fmt::format("$data{} with linespoints linecolor rgb '{}' linewidth 2 dashtype {} "
                          "pointtype {} pointsize 1 {}",
                          i, colour, DASHES[shape], FILLED[shape], title));
  }
  return fmt::format("plot {}\n", join_texts(curves, ", \\\n     "));
}

}  // namespace

std::string make_gnuplot_script(const Plot& plot) {
  Extent x, y;
  const auto data = make_data(plot, x, y);
  std::string text = "set encoding utf8\nset samples 400\n" + data;
  text += fmt::format("set title {} font ',17' offset 0,-0.3\n", quote_for_gnuplot(plot.title));
  text += fmt::format("set xlabel {} offset 0,0.8\n", quote_for_gnuplot(plot.x_label));
  text += fmt::format("set ylabel {}\n", quote_for_gnuplot(plot.y_label));
  text +=
      "set border 3 linecolor rgb '#404040'\nset tics nomirror out scale 0.6\nset format '%h'\nset "
      "xtics offset 0,0.2\n";
  text += "set grid linetype 1 linecolor rgb '#d8d8d8' linewidth 0.8\n";
  text += "set key outside bottom center horizontal Left reverse samplen 4 height 0.6 noenhanced\n";
  text += make_ranges(plot, x, y) + make_x_ticks(plot, x) + make_curves(plot);
  return text;
}

}  // namespace experiments

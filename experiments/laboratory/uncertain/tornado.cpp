#include "experiments/laboratory/uncertain/tornado.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace laboratory {

namespace {

constexpr std::size_t MOST_BARS = 12;
constexpr double SCREEN_WIDTH = 800, SCREEN_FONT = 15;

// Quotes a name for gnuplot. Names of entries and columns contain no characters that need escaping.
std::string quote(const std::string& name) { return "\"" + name + "\""; }

std::size_t count_bars(const std::vector<Weight>& weights) {
  return std::min(MOST_BARS, weights.size());
}

// Heights from the bottom: legend, numbers and label of the axis, bars, title. In pixels for the
// screen and in points for a figure.
struct Layout {
  double font = SCREEN_FONT;
  int key_columns = 2;
  double key, below, bars, above;

  Layout(std::size_t count, const base::FigureStyle& style) {
    constexpr double LETTERS = 2 * 28;  // of the legend in one line, with its samples
    if (style.is_figure()) font = style.font_pt;
    const double width = style.is_figure() ? style.width_pt() : SCREEN_WIDTH;
    if (0.6 * font * LETTERS > width) key_columns = 1;
    key = font * (key_columns == 1 ? 3.2 : 1.8);
    below = 5 * font;
    bars = 1.75 * font * static_cast<double>(count);
    above = font * (style.is_figure() ? 0.6 : 3);
  }
  double sum() const { return std::ceil(key + below + bars + above); }
};

// The step between ticks, so that there are three to five; in a figure, three.
double choose_tick_step(double largest, const base::FigureStyle& style) {
  const double power = std::pow(10, std::floor(std::log10(largest)));
  double step = power;
  for (const double factor : {2, 5})
    if (factor * power <= largest) step = factor * power;
  return style.is_figure() ? step * std::floor(largest / step) : step;
}

}  // namespace

int tornado_height(const std::vector<Weight>& weights, const base::FigureStyle& style) {
  return static_cast<int>(Layout(count_bars(weights), style).sum());
}

std::string make_tornado_script(const std::string& column, const std::vector<Weight>& weights,
                                const base::FigureStyle& style) {
  if (weights.empty()) throw std::invalid_argument("a tornado chart needs assumptions");
  auto sorted = weights;
  std::ranges::stable_sort(sorted, std::greater(),
                           [](const Weight& weight) { return std::abs(weight.share); });
  sorted.resize(count_bars(weights));
  std::string data, tics;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    data += fmt::format("{} {}\n", sorted.size() - i, 100 * sorted[i].share);
    tics += fmt::format("{}{} {}", i > 0 ? ", " : "", quote(sorted[i].entry), sorted.size() - i);
  }
  const Layout layout(sorted.size(), style);
  const auto edge = [&](double height) { return fmt::format("{:.4f}", height / layout.sum()); };
  const double largest = 100 * std::abs(sorted[0].share), bottom = layout.key + layout.below;
  const auto ticks = largest > 0 ? fmt::format("set xtics {0}\nset xrange [-{1}:{1}]\n",
                                               choose_tick_step(largest, style), 1.05 * largest)
                                 : "";
  const auto title = style.is_figure()
                         ? ""
                         : "set title " + quote("Influence of assumptions on " + column) +
                               " font ',15' noenhanced\n";
  // Draws two bars for each entry: a blue one for the change of the result at the high end of the
  // entry's range, and an orange one for the low end.
  return "reset\nset encoding utf8\n$bars << END\n" + data +
         "END\nset border 1 linecolor rgb '#404040'\nset xtics nomirror out scale 0.6\n" + ticks +
         "set ytics nomirror scale 0 (" + tics +
         ")\nset grid xtics linetype 1 linecolor rgb '#d8d8d8' linewidth 0.8\n"
         "set style fill solid 0.85 noborder\nset bmargin at screen " +
         edge(bottom) + "\nset tmargin at screen " + edge(bottom + layout.bars) +
         "\nset key at screen 0.5," + edge(layout.key) +
         fmt::format(
             " center top horizontal Left reverse samplen 2 maxcols {}\nset yrange [0.4:{}.6]\n",
             layout.key_columns, sorted.size()) +
         title +
         "set ytics noenhanced\nset xlabel 'change of the result [%]'\n"
         "plot $bars using (0):1:(0):2:($1-0.35):($1+0.35) with boxxyerror linecolor rgb '#0072B2' "
         "title 'at 95 % of its range', $bars using (0):1:(0):(-$2):($1-0.35):($1+0.35) with "
         "boxxyerror linecolor rgb '#D55E00' title 'at 5 %'\n";
}

}  // namespace laboratory

#include "experiments/laboratory/uncertain/tornado.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace laboratory {

namespace {

constexpr std::size_t MOST_BARS = 12;
constexpr int BAR = 26, AROUND = 150;  // height of a bar, and of the space around all bars, pixels

// Quotes a name for gnuplot. Names of entries and columns contain no characters that need escaping.
std::string quote(const std::string& name) { return "\"" + name + "\""; }

std::size_t count_bars(const std::vector<Weight>& weights) {
  return std::min(MOST_BARS, weights.size());
}

}  // namespace

int tornado_height(const std::vector<Weight>& weights) {
  return AROUND + BAR * static_cast<int>(count_bars(weights));
}

std::string make_tornado_script(const std::string& column, const std::vector<Weight>& weights) {
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
  // Draws two bars for each entry: a blue one for the change of the result at the high end of the
  // entry's range, and an orange one for the low end.
  return "reset\nset encoding utf8\n$bars << END\n" + data +
         "END\nset border 1 linecolor rgb '#404040'\nset xtics nomirror out scale 0.6\n"
         "set ytics nomirror scale 0 (" +
         tics +
         ")\nset grid xtics linetype 1 linecolor rgb '#d8d8d8' linewidth 0.8\n"
         "set style fill solid 0.85 noborder\nset bmargin 6\nset key at screen 0.5,0.05 center "
         "horizontal Left reverse samplen 2\n"
         "set yrange [0.4:" +
         fmt::format("{}.6]\n", sorted.size()) + "set title " +
         quote("Influence of assumptions on " + column) +
         " font ',15' noenhanced\nset ytics noenhanced\nset xlabel 'change of the result [%]'\n"
         "plot $bars using (0):1:(0):2:($1-0.35):($1+0.35) with boxxyerror linecolor rgb '#0072B2' "
         "title 'at 95 % of its range', $bars using (0):1:(0):(-$2):($1-0.35):($1+0.35) with "
         "boxxyerror linecolor rgb '#D55E00' title 'at 5 %'\n";
}

}  // namespace laboratory

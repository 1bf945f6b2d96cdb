#include "experiments/laboratory/report/gnuplot_curves.hpp"

#include <fmt/format.h>

#include <cmath>

#include "experiments/laboratory/report/gnuplot.hpp"

namespace laboratory {
namespace {

// Okabe and Ito's colours, which colour-blind readers tell apart, without the yellow that white
// paper swallows; darkest first. 9 symbols and 5 dashes: 45 different lines without any colour.
constexpr const char* COLOURS[] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                   "#E69F00", "#56B4E9", "#000000"};
// disc, square, triangle, diamond, triangle down, pentagon, cross, plus, star
constexpr int FILLED[] = {7, 5, 9, 13, 11, 15, 2, 1, 3};
constexpr int OPEN[] = {6, 4, 8, 12, 10, 14, 2, 1, 3};
constexpr const char* DASHES[] = {"solid", "(12,6)", "(3,5)", "(12,5,3,5)", "(12,4,3,4,3,4)"};

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

// The curve whose name, of all, is the longest in this one; else that of the same number.
std::size_t find_curve(const Plot& plot, const std::vector<std::size_t>& curves,
                       const std::string& name, std::size_t number) {
  std::size_t look = number, longest = 0;
  for (std::size_t k = 0; k < curves.size(); ++k) {
    const auto& words = plot.series[curves[k]].name;
    if (words.size() > longest && contains_words(name, words)) look = k, longest = words.size();
  }
  return look;
}

// Which of the looks each series wears.
std::vector<std::size_t> choose_looks(const Plot& plot) {
  std::vector<std::size_t> curves, looks;
  for (std::size_t i = 0; i < plot.series.size(); ++i)
    if (plot.series[i].kind == SeriesKind::curve) curves.push_back(i);
  std::size_t curve = 0, other = 0;
  for (const auto& series : plot.series)
    if (series.kind == SeriesKind::curve)
      looks.push_back(curve++);
    else if (series.of)
      looks.push_back(*series.of);
    else
      looks.push_back(find_curve(plot, curves, series.name, other++));
  return looks;
}

bool has_points(const Plot& plot, const Series& s) {
  for (std::size_t i = 0; i < s.x.size(); ++i)
    if (is_drawn(plot, s.x[i], s.y[i])) return true;
  return false;
}

std::string make_style(SeriesKind kind, std::size_t look) {
  const auto colour = fmt::format("linecolor rgb '{}'", COLOURS[look % std::size(COLOURS)]);
  const auto shape = look % std::size(FILLED);
  switch (kind) {
    case SeriesKind::curve:
      return fmt::format("with linespoints {} linewidth 2 dashtype {} pointtype {} pointsize 1",
                         colour, DASHES[look % std::size(DASHES)], FILLED[shape]);
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

std::string make_title(const Series& series) {
  return series.name.empty() ? "notitle" : "title " + quote_for_gnuplot(series.name);
}

}  // namespace

bool is_drawn(const Plot& plot, double x, double y) {
  return std::isfinite(x) && std::isfinite(y) && (!plot.log_x || x > 0) && (!plot.log_y || y > 0);
}

std::string make_curves(const Plot& plot) {
  std::vector<std::string> curves;
  if (plot.ideal_line)
    curves.push_back(
        "x with lines linecolor rgb '#707070' linewidth 1.5 dashtype (18,9) title 'ideal'");
  const auto looks = choose_looks(plot);
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const Series& s = plot.series[i];
    if (has_points(plot, s))
      curves.push_back(
          fmt::format("$data{} {} {}", i, make_style(s.kind, looks[i]), make_title(s)));
  }
  return join_texts(curves, ", \\\n     ");
}

std::string make_difference_curves(const Plot& plot) {
  std::vector<std::string> curves{
      "0 with lines linecolor rgb '#707070' linewidth 1 dashtype solid notitle"};
  for (std::size_t i = 0; i < plot.differences.size(); ++i)
    curves.push_back(
        fmt::format("$difference{} {} notitle", i,
                    make_style(SeriesKind::curve, plot.differences[i].of.value_or(i))));
  return join_texts(curves, ", \\\n     ");
}

}  // namespace laboratory

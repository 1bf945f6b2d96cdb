#include "experiments/laboratory/plot/plot_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.hpp"

namespace laboratory {
namespace {

// The first `count` letters of a text in UTF-8.
std::string first_letters(std::string_view text, std::size_t count) {
  std::size_t end = 0;
  for (std::size_t i = 0; i < count && end < text.size(); ++i)
    end += std::max<std::size_t>(1, base::measure_utf8(text.substr(end)));
  return std::string(text.substr(0, end));
}

}  // namespace

PlotSize choose_size(const base::FigureStyle& style) {
  if (!style.is_figure()) return {};
  // a wider figure has a smaller height, relative to its width
  const double upper = 75 + 0.18 * style.width_pt();
  return {style.width_pt(), style.font_pt, upper, 0.4 * upper, false};
}

LegendLayout arrange_legend(const Plot& plot, const PlotSize& size) {
  std::size_t entries = plot.ideal_line ? 1 : 0, longest = 5;
  for (const auto& series : plot.series) {
    entries += !series.name.empty();
    longest = std::max(longest, width_of(series.key()));
  }
  // widths of the legend, of an entry's line with its gap, and of a letter
  const double room = 0.875 * size.width, sample = size.scale(90), letter = size.scale(10);
  const auto most = static_cast<std::size_t>(std::max(5.0, (room - sample) / letter));
  longest = std::min(longest, most);
  const auto columns = std::max<std::size_t>(
      1, static_cast<std::size_t>(room / (sample + letter * static_cast<double>(longest))));
  auto lines = (entries + columns - 1) / columns;
  if (entries > 0 && !plot.legend_title.empty()) ++lines;
  return {static_cast<int>(lines), static_cast<int>(columns), most};
}

std::string shorten_middle(const std::string& text, std::size_t most) {
  const auto letters = width_of(text);
  if (letters <= most) return text;
  const std::size_t before = (most - 1) / 2, after = most - 1 - before;
  const auto skipped = first_letters(text, letters - after).size();
  return first_letters(text, before) + "…" + text.substr(skipped);
}

std::vector<std::string> break_label(const std::string& text, std::size_t most) {
  if (width_of(text) <= most) return {text};
  // breaks at the last blank of the first line, or else within a word
  const auto start = first_letters(text, most);
  const auto blank = start.rfind(' ');
  const bool has_blank = blank != std::string::npos && blank > start.size() / 3;
  const auto first = has_blank ? start.substr(0, blank) : start;
  return {first, shorten_middle(text.substr(first.size() + has_blank), most)};
}

std::vector<TickLabel> label_log_ticks(const std::vector<double>& ticks, double low, double high,
                                       double length, const PlotSize& size) {
  std::vector<TickLabel> labels;
  double free_from = -INFINITY;  // position where the last label ends
  for (const double tick : ticks) {
    const auto text = fmt::format("{:g}", tick);
    const double middle = length * std::log(tick / low) / std::log(high / low);
    const double half = 0.5 * size.width_of(text.size());
    const bool fits = middle - half >= free_from;
    labels.push_back({tick, fits ? text : ""});
    if (fits) free_from = middle + half + 0.4 * size.font;
  }
  return labels;
}

}  // namespace laboratory

#include "experiments/laboratory/plot/plot_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <kainjow/mustache.hpp>
#include <stdexcept>
#include <utility>

#include "experiments/laboratory/plot/plot_axes.hpp"
#include "experiments/laboratory/plot/plot_files.hpp"

namespace laboratory {
namespace {

namespace mustache = kainjow::mustache;

// Formats the edges of a curve's band as x, low and high. Skips points that cannot be drawn.
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

// Okabe and Ito's colours, distinct for colour-blind readers, darkest first, without yellow, which
// is invisible on white.
constexpr const char* COLOURS[] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                   "#E69F00", "#56B4E9", "#000000"};
// gnuplot's numbers for the symbols that Look::symbol lists.
constexpr int FILLED[] = {7, 5, 9, 13, 11, 15, 2, 1, 3};
constexpr int OPEN[] = {6, 4, 8, 12, 10, 14, 2, 1, 3};
constexpr std::size_t DISC = 0, WITH_AREA = 6;  // the first symbols can be filled
constexpr const char* DASHES[] = {"", "12,6", "3,5", "12,5,3,5", "12,4,3,4,3,4"};

// Lengths of dashes for gnuplot: "(12,6)".
std::string make_dashes(const char* gaps) {
  return *gaps ? fmt::format("dashtype ({})", gaps) : "dashtype solid";
}

// Formats the width of a line: "linewidth 2".
std::string make_width(const PlotSize& size, double width) {
  return fmt::format("linewidth {:.4g}", size.scale(width));
}

std::string make_style(SeriesKind kind, std::size_t look, const PlotSize& size) {
  const auto [code, gaps, shape] = look_of(look);
  const auto colour = fmt::format("linecolor rgb '{}'", code);
  const auto dashes = make_dashes(gaps);
  switch (kind) {
    case SeriesKind::curve:
      return fmt::format("with linespoints {} {} {} pointtype {} pointsize 1", colour,
                         make_width(size, 2), dashes, FILLED[shape]);
    case SeriesKind::reference:
      return fmt::format("with points {} {} pointtype {} pointsize 1.5", colour,
                         make_width(size, 2), OPEN[shape]);
    case SeriesKind::law:
      return fmt::format("with lines {} {} dashtype solid", colour, make_width(size, 1));
    case SeriesKind::saturated:
      return fmt::format("with points {} {} pointtype {} pointsize 1", colour, make_width(size, 2),
                         OPEN[shape < WITH_AREA ? shape : DISC]);
    case SeriesKind::mark:
      break;
  }
  return fmt::format("with points linecolor rgb '#000000' {} pointtype 6 pointsize 2.4",
                     make_width(size, 1.5));
}

// The style of a series, in the look of the curve that it belongs to.
std::string make_style(const Series& s, std::size_t look, const PlotSize& size) {
  if (!s.is_stepped) return make_style(s.kind, look, size);
  const auto [colour, gaps, shape] = look_of(look);
  return fmt::format("with steps linecolor rgb '{}' {} {}", colour, make_width(size, 2),
                     make_dashes(gaps));
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

// Adds error bars, behind the symbols of their curve. Point type 0 has no symbol.
void add_bars(Panel& panel, std::size_t series, const std::string& bars, const Look& look,
              const PlotSize& size) {
  if (bars.empty()) return;
  panel.data += fmt::format("$bars{} << END\n{}END\n", series, bars);
  panel.curves.push_back(
      fmt::format("$bars{} with yerrorbars linecolor rgb '{}' {} dashtype solid pointtype 0 "
                  "pointsize 0 notitle",
                  series, look.colour, make_width(size, 1.5)));
}

// Covers the symbols of a curve in white, before hollow symbols are drawn over them. The entry of
// the legend stands for all curves.
void add_cover(Panel& panel, const std::string& name, const std::vector<Dot>& points,
               std::size_t look, const PlotSize& size, const std::string& title) {
  if (points.empty()) return;
  const auto shape = look_of(look).symbol;
  panel.add(name, points,
            fmt::format("with points linecolor rgb '#ffffff' {} pointtype {} pointsize 1.2",
                        make_width(size, 2), FILLED[shape < WITH_AREA ? shape : DISC]),
            "notitle");
  if (title != "notitle")
    panel.curves.push_back(
        fmt::format("keyentry with points linecolor rgb '#404040' {} pointtype {} pointsize 1 {}",
                    make_width(size, 2), OPEN[DISC], title));
}

// Adds the ideal line and the level, dashed.
void add_guides(Panel& panel, const Plot& plot, const PlotSize& size) {
  const auto style =
      fmt::format("with lines linecolor rgb '#707070' {} dashtype (18,9)", make_width(size, 1.5));
  if (plot.ideal_line) panel.curves.push_back(fmt::format("x {} title 'ideal'", style));
  if (plot.level) panel.curves.push_back(fmt::format("{} {} notitle", *plot.level, style));
}

Panel make_upper(const Plot& plot, const PlotSize& size) {
  Panel panel;
  add_guides(panel, plot, size);
  std::size_t banded = 0;  // index of the next curve; bands and bars lie behind all curves
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const Series& s = plot.series[i];
    if (s.kind != SeriesKind::curve) continue;
    const auto look = look_of(banded++);
    if (s.has_bars) {
      add_bars(panel, i, make_bars(plot, s), look, size);
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
  const auto longest = arrange_legend(plot, size).longest;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const Series& s = plot.series[i];
    const auto look = s.kind == SeriesKind::curve ? curve++ : s.of;
    const auto points = upper_points(plot, s);
    auto title =
        s.name.empty() ? "notitle" : "title " + quote_for_gnuplot(shorten_middle(s.key(), longest));
    if (s.kind == SeriesKind::saturated)
      add_cover(panel, fmt::format("cover{}", i), points, look, size,
                std::exchange(title, "notitle"));
    panel.add(fmt::format("data{}", i), points, make_style(s, look, size), title);
  }
  return panel;
}

Panel make_lower(const Plot& plot, const PlotSize& size) {
  Panel panel;
  panel.curves.push_back(fmt::format(
      "0 with lines linecolor rgb '#707070' {} dashtype solid notitle", make_width(size, 1)));
  for (std::size_t i = 0; i < plot.differences.size(); ++i) {
    const Series& s = plot.differences[i];
    panel.add(fmt::format("difference{}", i), lower_points(plot, s),
              make_style(SeriesKind::curve, s.of, size), "notitle");
  }
  return panel;
}

// Lines of the label of x, which is centred below the axis.
std::vector<std::string> break_x_label(const Plot& plot, const PlotSize& size) {
  const double length = find_x_length(plot, measure_axes(plot), size);
  return break_label(plot.x_label, static_cast<std::size_t>(length / size.width_of(1)));
}

// Heights of a drawing from the bottom: legend, x label and numbers, lower panel with the gap above
// it, upper panel, title. `lower` includes the gap; it is 0 without a lower panel.
struct Heights {
  double key, below, lower, gap, above;

  Heights(const Plot& plot, const PlotSize& size)
      : key(size.scale(8) + size.scale(21) * arrange_legend(plot, size).lines),
        below(size.scale(62) +
              size.scale(21) * static_cast<double>(break_x_label(plot, size).size() - 1)),
        lower(plot.differences.empty() ? 0 : size.lower + size.scale(16)),
        gap(size.scale(16)),
        above(size.has_title ? size.scale(50) : size.scale(12)) {}
  double sum(const PlotSize& size) const { return key + below + lower + size.upper + above; }
};

// Chooses the font size of the title: the longer the title, the smaller.
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

int choose_height(const Plot& plot, const PlotSize& size) {
  return static_cast<int>(std::ceil(Heights(plot, size).sum(size)));
}

namespace {

// Quotes the lines of a label. A line end becomes "\n" in gnuplot's language.
std::string quote_lines(const std::vector<std::string>& lines) {
  std::string quoted;
  for (const auto& line : lines) {
    const auto one = quote_for_gnuplot(line);
    quoted += (quoted.empty() ? "\"" : "\\n") + one.substr(1, one.size() - 2);
  }
  return quoted + "\"";
}

mustache::object make_labels(const Plot& plot, const PlotSize& size) {
  return {{"title", size.has_title ? quote_for_gnuplot(plot.title) : "\"\""},
          {"title_size", choose_title_size(plot.title)},
          {"key_title",
           plot.legend_title.empty() ? "" : "title " + quote_for_gnuplot(plot.legend_title + ":")},
          {"x_label", quote_lines(break_x_label(plot, size))},
          {"y_label", quote_lines(break_y_label(plot.y_label, size.upper, size))},
          {"lower_label", quote_lines(break_y_label(plot.difference_label, size.lower, size))}};
}

}  // namespace

std::string make_gnuplot_script(const Plot& plot, const PlotSize& size) {
  if (!has_points(plot))
    throw std::invalid_argument(fmt::format("plot {}: no points to draw", plot.name));
  const Axes axes = measure_axes(plot);
  const Panel upper = make_upper(plot, size), lower = make_lower(plot, size);
  const Heights heights(plot, size);
  const auto margins = find_margins(plot, axes, size);
  const double bottom = heights.key + heights.below + heights.lower;  // edge of the upper panel
  const auto edge = [&](double height) {
    return fmt::format("{:.4f}", height / choose_height(plot, size));
  };
  const auto across = [&](double width) { return fmt::format("{:.4f}", width / size.width); };
  auto page = make_labels(plot, size);
  page.insert({{"data", upper.data + lower.data},
               {"scales", make_scales(plot, axes)},
               {"x_range", make_x_range(plot, axes.x)},
               {"x_ticks", make_x_ticks(plot, axes, size, true)},
               {"line", fmt::format("{:.4g}", size.scale(1))},
               {"grid", fmt::format("{:.4g}", size.scale(0.8))},
               {"key_top", edge(heights.key)},
               {"key_columns", std::to_string(arrange_legend(plot, size).columns)},
               {"y_range", make_y_range(plot, axes)},
               {"left", across(margins.left)},
               {"right", across(size.width - margins.right)},
               {"bottom", edge(bottom)},
               {"top", edge(bottom + size.upper)},
               {"curves", upper.join()},
               {"lower", !plot.differences.empty()},
               {"x_marks", make_x_ticks(plot, axes, size, false)},
               {"lower_range", make_difference_range(axes.difference)},
               {"lower_bottom", edge(bottom - heights.lower)},
               {"lower_top", edge(bottom - heights.gap)},
               {"lower_curves", lower.join()}});
  mustache::mustache script(PLOT_TEMPLATE);
  script.set_custom_escape([](const std::string& text) { return text; });
  return script.render(page);
}

}  // namespace laboratory

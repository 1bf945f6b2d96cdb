// Layout of plots: sizes of their parts, and texts that fit into them.
#pragma once

#include <string>
#include <vector>

#include "base/figure/figure_style.hpp"
#include "experiments/laboratory/plot/plot.hpp"

namespace laboratory {

/// Lengths of a plot, in pixels for the screen and in points for a figure.
struct PlotSize {
  double width = 800, font = 15;
  double upper = 325, lower = 130;  ///< heights of the panels
  bool has_title = true;

  /// A length that is proportional to the font size. `pixels` is the length on the screen.
  double scale(double pixels) const { return pixels * font / 15; }
  /// The estimated width of a text of `letters` letters.
  double width_of(std::size_t letters) const { return 0.6 * font * static_cast<double>(letters); }
};

PlotSize choose_size(const base::FigureStyle& style);

/// Layout of the legend. It has at most as many columns as gnuplot itself would choose. With more
/// columns, gnuplot would change the number of lines.
struct LegendLayout {
  int lines = 0, columns = 1;
  std::size_t longest = 0;  ///< number of letters that fit into an entry
};

LegendLayout arrange_legend(const Plot& plot, const PlotSize& size);

/// Replaces letters in the middle of a text that has more than `most` letters by "…".
std::string shorten_middle(const std::string& text, std::size_t most);

/// Breaks a label into at most two lines of about `most` letters, and shortens what is longer.
std::vector<std::string> break_label(const std::string& text, std::size_t most);

/// A tick with its label, "" if the label would overlap its neighbours.
struct TickLabel {
  double at;
  std::string text;
};

/// Labels ticks on a logarithmic axis of this length between `low` and `high`.
std::vector<TickLabel> label_log_ticks(const std::vector<double>& ticks, double low, double high,
                                       double length, const PlotSize& size);

}  // namespace laboratory

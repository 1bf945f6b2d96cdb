// Plots as scripts in gnuplot's language.
#pragma once

#include <string>
#include <string_view>

#include "experiments/laboratory/plot/plot.hpp"
#include "experiments/laboratory/plot/plot_layout.hpp"

namespace laboratory {

/// Style of a curve. 45 styles can be distinguished even without colours.
struct Look {
  const char* colour;  ///< colour, such as "#0072B2"
  const char* dashes;  ///< lengths of dashes and gaps, "12,6"; "": solid line
  /// Index of the symbol: disc, square, triangle, diamond, triangle down, pentagon, cross, plus,
  /// star.
  std::size_t symbol;
};
/// The style of a curve, by its index among the plot's curves. After the last style, the first one
/// follows.
Look look_of(std::size_t curve);

/// Quotes a text as a literal of gnuplot's language, so that gnuplot expands no variable, escape
/// sequence or command in it. Control characters become blanks.
std::string quote_for_gnuplot(std::string_view text);

/// Makes the script of a plot, without terminal and output. Throws std::invalid_argument with the
/// plot's name if the plot has no points, or a series has different numbers of x and y.
std::string make_gnuplot_script(const Plot& plot, const PlotSize& size = {});

/// The height of the drawing. It grows with the legend, a second panel, and labels of two lines.
int choose_height(const Plot& plot, const PlotSize& size = {});

/// True if the plot has a point that can be drawn: it is finite, and positive on a logarithmic
/// scale. Throws as make_gnuplot_script() does for a series with different numbers of x and y.
bool has_points(const Plot& plot);

}  // namespace laboratory

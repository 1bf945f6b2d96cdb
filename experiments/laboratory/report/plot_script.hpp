// Plots as scripts in gnuplot's language.
#pragma once

#include <string>
#include <string_view>

#include "experiments/laboratory/report/plot.hpp"

namespace laboratory {

/// Style of a curve. 45 styles can be told apart even without colour.
struct Look {
  const char* colour;  ///< colour, such as "#0072B2"
  const char* dashes;  ///< lengths of dashes and gaps, "12,6"; "": solid line
  /// Index into disc, square, triangle, diamond, triangle down, pentagon, cross, plus, star.
  std::size_t symbol;
};
/// The style of a curve, by its index among the plot's curves. Styles repeat when exhausted.
Look look_of(std::size_t curve);

/// Quotes a text as a literal of gnuplot's language. No variable, escape or command in it is
/// expanded. Control characters become blanks.
std::string quote_for_gnuplot(std::string_view text);

/// Makes the script of a plot, without terminal and output. Throws std::invalid_argument with the
/// plot's name if the plot has no points, or a series has different numbers of x and y.
std::string make_gnuplot_script(const Plot& plot);

/// The height of the drawing for a width of 800, both in pixels. It grows with the legend and a
/// second panel.
int choose_height(const Plot& plot);

/// True if the plot has a finite point, which must be positive on a logarithmic scale. Throws as
/// make_gnuplot_script does for series of unequal lengths.
bool has_points(const Plot& plot);

}  // namespace laboratory

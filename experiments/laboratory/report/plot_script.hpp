// Plots in gnuplot's language.
#pragma once

#include <string>
#include <string_view>

#include "experiments/laboratory/report/plot.hpp"

namespace laboratory {

/// Style of a curve; 45 of them differ even without colour.
struct Look {
  const char* colour;  ///< "#0072B2"
  const char* dashes;  ///< lengths of dashes and gaps, "12,6"; "" for a solid line
  std::size_t symbol;  ///< disc, square, triangle, diamond, triangle down, pentagon, cross, plus,
                       ///< star
};
/// `curve` is the index among the plot's curves; looks repeat from 0 when exhausted.
Look look_of(std::size_t curve);

/// A text as a literal of gnuplot's language without any expansion: no variable, no escape, no
/// command. Control characters become blanks.
std::string quote_for_gnuplot(std::string_view text);

/// The plot as a script that sets neither terminal nor output. Throws std::invalid_argument, naming
/// the plot, if it has no points or a series with unequal numbers of x and y.
std::string make_gnuplot_script(const Plot& plot);

/// Height of the drawing for a width of 800, both in pixels; a long key or a second panel increases
/// it.
int choose_height(const Plot& plot);

/// True if the plot has a finite point, above 0 on a logarithmic scale. Throws as
/// make_gnuplot_script does for series of unequal lengths.
bool has_points(const Plot& plot);

}  // namespace laboratory

// Plots in gnuplot's language.
#pragma once

#include <string>
#include <string_view>

#include "experiments/laboratory/report/plot.hpp"

namespace laboratory {

/// How a curve looks, so that 45 of them differ without any colour.
struct Look {
  const char* colour;  ///< "#0072B2"
  const char* dashes;  ///< lengths of dashes and gaps, "12,6"; "" for a line without gaps
  std::size_t symbol;  ///< disc, square, triangle, diamond, triangle down, pentagon, cross, plus,
                       ///< star
};
/// `curve` is its index among the plot's curves; looks come again from 0 when they are used up.
Look look_of(std::size_t curve);

/// A text as a literal of gnuplot's language in which nothing is expanded: no variable, no escape,
/// no command. Control characters become blanks.
std::string quote_for_gnuplot(std::string_view text);

/// The plot as a script that sets neither terminal nor output. Throws std::invalid_argument, naming
/// the plot, where it has no points or a series with more x than y or fewer.
std::string make_gnuplot_script(const Plot& plot);

/// Height of the drawing for a width of 800, both in pixels: a long key or a second panel adds to
/// it.
int choose_height(const Plot& plot);

/// Whether there is something to draw: a finite point, above 0 on a logarithmic scale. Throws as
/// make_gnuplot_script for series of unequal lengths.
bool has_points(const Plot& plot);

}  // namespace laboratory

// Plots as JSON, for the script in the report's page.
#pragma once

#include <string>

#include "experiments/laboratory/plot/plot.hpp"

namespace laboratory {

/// Formats a plot as JSON: labels, scales, and series with their styles and points. A point is [x,
/// y, n], where `table` gives n, the number of the point in the sweep. A plot of speed-up also has
/// the serial fractions, 0 to 1, of Amdahl's and Gustafson's laws fitted to its curves. Omits a law
/// that is already a series.
std::string make_plot_data(const Plot& plot, const Table& table);

}  // namespace laboratory

// Plots as JSON, for the script in the report's page.
#pragma once

#include <string>

#include "experiments/laboratory/plot/plot.hpp"

namespace laboratory {

/// Formats a plot as JSON: labels, scales, and series with their styles and points. A point is [x,
/// y, number of its point in the sweep]; `table` gives this number. A plot of speed-up also has the
/// serial fractions, 0 to 1, of Amdahl's and Gustafson's laws fitted to its curves. Omits a law
/// that is already a series.
std::string make_plot_data(const Plot& plot, const Table& table);

}  // namespace laboratory

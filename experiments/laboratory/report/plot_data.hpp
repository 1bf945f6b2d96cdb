// Plots as JSON for the script of the report.
#pragma once

#include <string>

#include "experiments/laboratory/report/plot.hpp"

namespace laboratory {

/// Formats a plot as JSON: labels, scales, and series with their styles and points. A point is [x,
/// y, number of its sweep point]; `table` has the sweep points. A speed-up also has the serial
/// fractions, 0 to 1, of fits of Amdahl's and Gustafson's laws to its curves. A law that is already
/// a series is omitted.
std::string make_plot_data(const Plot& plot, const Table& table);

}  // namespace laboratory

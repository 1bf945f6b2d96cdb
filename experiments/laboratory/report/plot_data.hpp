// Plots as JSON for the page's script.
#pragma once

#include <string>

#include "experiments/laboratory/report/plot.hpp"

namespace laboratory {

/// The plot as JSON: labels, scales, and series with their looks and points [x, y, point of the
/// sweep], which `table` gives for each row. A speed-up also has the serial fractions, 0 to 1, from
/// fits of Amdahl's and Gustafson's laws to its curves, unless that law is already a series.
std::string make_plot_data(const Plot& plot, const Table& table);

}  // namespace laboratory

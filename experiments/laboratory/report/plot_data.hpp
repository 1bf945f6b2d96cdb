// Plots as the page's script reads them.
#pragma once

#include <string>

#include "experiments/laboratory/report/plot.hpp"

namespace laboratory {

/// The plot as JSON: labels, scales, series with their looks and points [x, y, point of the sweep],
/// where `table` says which point each row is. A speed-up has the serial fractions, from 0 to 1,
/// that Amdahl's and Gustafson's laws fit to its curves, but for laws that are series already.
std::string make_plot_data(const Plot& plot, const Table& table);

}  // namespace laboratory

#pragma once
// Plots of histograms: [[plot]] with kind = "histogram".

#include "experiments/laboratory/judge/rows.hpp"
#include "experiments/laboratory/plot/plot.hpp"

namespace laboratory {

/// Makes the plot of a quantity of histogram.csv for the points of these rows of the results.
/// Points that agree on the axes `series` share a curve, which counts the values of all of them.
/// The x axis is logarithmic if all bounds of bins are positive. Has no series if no point has
/// values.
Plot plot_histogram(const Table& histograms, const std::string& quantity, const Table& table,
                    const RowList& rows, const std::vector<std::size_t>& series);

}  // namespace laboratory

#pragma once
// Saturation in sweeps over the load: which points are beyond it, and where it begins.

#include <string>
#include <vector>

#include "experiments/laboratory/plot/plot.hpp"
#include "simulator/programs/declare/program.hpp"

namespace laboratory {

/// Adds a series with the points of each curve that are beyond saturation. A mean over seeds is
/// beyond saturation if at least half of its samples are. The first of these series has the name
/// that the legend shows. `table` is the table whose rows the curves refer to.
void mark_saturated(Plot& plot, const Table& table, const programs::SaturationColumns& columns);

/// Makes a sentence for each combination of values of the other axes: "pattern = transpose:
/// saturated from load 0.35 on; the bound by the busiest link is 0.333." After twelve sentences,
/// one states how many more there would be. Empty if the sweep has no axis of the load with at
/// least two values.
std::vector<std::string> tell_saturation(const Table& table,
                                         const programs::SaturationColumns& columns);

}  // namespace laboratory

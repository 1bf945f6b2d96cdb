// What plots show, in sentences: where each curve bends, what limits it, which is largest.
#pragma once

#include <string>
#include <vector>

#include "experiments/laboratory/report/plot.hpp"
#include "experiments/laboratory/report/point_loads.hpp"

namespace laboratory {

/// At most one sentence of each kind about each plot, curves of which the same is true together:
/// - bends (fit_growth): "Speed-up bends at 4 workers for 200 objects (workers^0.95, then
///   workers^0.35)";
/// - limits, where the points' loads are known: "Limited by coordination from 6 workers on for 200
///   objects (at 7 workers 0.98: its CPU 42 %, waiting for replies 52 %)", once for the same
///   points;
/// - the largest and the smallest y, at the largest x that at least half of the curves have.
/// Rows of the series are those of `table`. `titled`: the sentences about a plot are one text,
/// which begins with the plot's title unless that is y.
std::vector<std::string> tell_plots(const std::vector<Plot>& plots, bool titled, const Table& table,
                                    const std::vector<PointLoads>& points);

/// What limits the points, for results without plots: of one point explain(), else how many each
/// resource limits, "Limited: 30 of 52 points by coordination, 10 by tasks; in 12 nothing is
/// saturated." None where no loads are known.
std::vector<std::string> tell_points(const std::vector<PointLoads>& points);

}  // namespace laboratory

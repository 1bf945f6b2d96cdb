// Sentences about plots: bends of curves, limits of points, and the largest curve.
#pragma once

#include <string>
#include <vector>

#include "experiments/laboratory/report/plot.hpp"
#include "experiments/laboratory/report/point_loads.hpp"

namespace laboratory {

/// Makes at most one sentence of each kind about each plot. Curves with the same finding share a
/// sentence. The kinds are
/// - bends (fit_power_law): "Speed-up bends at 4 workers for 200 objects (workers^0.95, then
///   workers^0.35)";
/// - limits, if the points' loads are known: "Limited by coordination from 6 workers on for 200
///   objects (at 7 workers 0.98: its CPU 42 %, waiting for replies 52 %)", unless an earlier plot
///   has curves that end at the same points;
/// - the largest and the smallest y, at the largest x that at least half of the curves have.
/// The rows of the series are those of `table`. With `titled`, the sentences about a plot form one
/// text. It begins with the plot's title, unless the title only names y.
std::vector<std::string> tell_plots(const std::vector<Plot>& plots, bool titled, const Table& table,
                                    const std::vector<PointLoads>& points);

/// Makes sentences about the limits of the points, for results without plots. A single point yields
/// explain(). Several points are counted by resource: "Limited: 30 of 52 points by coordination, 10
/// by tasks; in 12 nothing is saturated." Empty if no loads are known.
std::vector<std::string> tell_points(const std::vector<PointLoads>& points);

}  // namespace laboratory

// Sentences about plots: where curves bend, what limits the points, and which curve is the largest.
#pragma once

#include <string>
#include <vector>

#include "experiments/laboratory/plot/plot.hpp"
#include "experiments/laboratory/report/point_loads.hpp"

namespace laboratory {

/// Makes at most one sentence of each kind about each plot. Curves with equal findings share a
/// sentence. The kinds are
/// - bends of curves (see fit_power_law): "Speed-up bends at 4 workers for 200 objects
///   (workers^0.95, then workers^0.35)";
/// - limiting resources, if the loads of the points are known: "Limited by coordination from 6
///   workers on for 200 objects (at 7 workers 0.98: its CPU 42 %, waiting for replies 52 %)". This
///   sentence is omitted if the curves of an earlier plot end at the same points;
/// - the largest and the smallest y, at the largest x that at least half of the curves have.
/// `table` is the table whose rows the series refer to. If `titled`, the sentences about a plot are
/// joined. The joined text begins with the plot's title, unless the title is only the name of y.
std::vector<std::string> tell_plots(const std::vector<Plot>& plots, bool titled, const Table& table,
                                    const std::vector<PointLoads>& points);

/// Makes sentences about the resources that limit the points, for results without plots. explain()
/// makes the sentence about a single point. Several points are counted by resource: "Limited: 30 of
/// 52 points by coordination, 10 by tasks; in 12 nothing is saturated." Empty if no loads are
/// known.
std::vector<std::string> tell_points(const std::vector<PointLoads>& points);

}  // namespace laboratory

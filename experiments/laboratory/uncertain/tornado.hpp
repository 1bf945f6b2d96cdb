#pragma once
// Tornado chart of the influences of model entries on a result: one bar for each entry, the longest
// bar at the top.
#include <string>

#include "base/figure/figure_style.hpp"
#include "experiments/laboratory/uncertain/confidence.hpp"

namespace laboratory {

/// Makes the gnuplot script for a chart with the height tornado_height(). A figure for a paper has
/// no title. Throws std::invalid_argument if there are no weights.
std::string make_tornado_script(const std::string& column, const std::vector<Weight>& weights,
                                const base::FigureStyle& style = {});
/// The height of the drawing in pixels; for a figure, in points.
int tornado_height(const std::vector<Weight>& weights, const base::FigureStyle& style = {});

}  // namespace laboratory

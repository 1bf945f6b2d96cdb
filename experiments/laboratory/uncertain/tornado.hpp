#pragma once
// Tornado chart of the influences of model entries on a result: one bar for each entry, the longest
// bar at the top.
#include <string>

#include "experiments/laboratory/uncertain/confidence.hpp"

namespace laboratory {

/// Makes the gnuplot script for a chart with the height tornado_height(). Throws
/// std::invalid_argument if there are no weights.
std::string make_tornado_script(const std::string& column, const std::vector<Weight>& weights);
int tornado_height(const std::vector<Weight>& weights);  ///< height of the drawing, pixels

}  // namespace laboratory

#pragma once
// A tornado chart of the effect of each assumption on a result, the largest at the top.
#include <string>

#include "experiments/laboratory/uncertain/confidence.hpp"

namespace laboratory {

/// The gnuplot script for a drawing of height tornado_height(). Throws std::invalid_argument
/// without weights.
std::string make_tornado_script(const std::string& column, const std::vector<Weight>& weights);
int tornado_height(const std::vector<Weight>& weights);  ///< pixels

}  // namespace laboratory

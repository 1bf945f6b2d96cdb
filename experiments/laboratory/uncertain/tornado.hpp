#pragma once
// A tornado chart: how far each assumption moves a result, the furthest at the top.
#include <string>

#include "experiments/laboratory/uncertain/sureness.hpp"

namespace laboratory {

/// The script for gnuplot, for a drawing of tornado_height(). Throws std::invalid_argument without
/// weights.
std::string make_tornado_script(const std::string& column, const std::vector<Weight>& weights);
int tornado_height(const std::vector<Weight>& weights);  ///< pixels

}  // namespace laboratory

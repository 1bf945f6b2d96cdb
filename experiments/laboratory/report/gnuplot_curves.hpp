#pragma once
// The curves of a plot in gnuplot's language: which colour, dash and symbol each wears.
#include <string>

#include "experiments/laboratory/report/plot.hpp"

namespace laboratory {

// Whether a point can be on these scales.
bool is_drawn(const Plot& plot, double x, double y);

// The arguments of `plot` for the upper panel, whose data stand in $data0, $data1, ...
std::string make_curves(const Plot& plot);
// For the lower one, in $difference0, ...
std::string make_difference_curves(const Plot& plot);

}  // namespace laboratory

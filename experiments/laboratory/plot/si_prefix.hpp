// SI prefixes on the axes of plots.
#pragma once

#include "experiments/laboratory/plot/plot.hpp"

namespace laboratory {

/// Scales the axes whose labels end in a unit, "[s]", "[bytes]", "[bit/s]" and the like, so that
/// the largest number is between 1 and 1000: an axis up to 0.0045 s is drawn in ms. Changes no axis
/// of a plot with an ideal line or a fitted law. Does not change a logarithmic axis of more than
/// three decades, or an x axis whose values are all powers of two.
void choose_prefixes(Plot& plot);

}  // namespace laboratory

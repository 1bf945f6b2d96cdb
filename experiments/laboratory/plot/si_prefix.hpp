// SI prefixes on the axes of plots.
#pragma once

#include "experiments/laboratory/plot/plot.hpp"

namespace laboratory {

/// Scales the axes whose labels end in a unit, "[s]", "[bytes]", "[bit/s]" and the like, so that
/// the largest number is between 1 and 1000: an axis up to 0.0045 s is drawn in ms. Axes stay as
/// they are if there is an ideal line or a fitted law. So do logarithmic axes of more than three
/// decades, and x if all values are powers of two.
void choose_prefixes(Plot& plot);

}  // namespace laboratory

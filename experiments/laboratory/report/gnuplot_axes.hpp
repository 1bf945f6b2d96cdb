#pragma once
// The axes of a plot in gnuplot's language: scales, ranges and ticks.
#include <algorithm>
#include <cmath>
#include <string>

#include "experiments/laboratory/report/plot.hpp"

namespace laboratory {

struct Extent {
  double low = INFINITY, high = -INFINITY;
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

// A logarithmic x whose points are powers of two has that base, and y with it where there is an
// ideal line.
std::string make_scales(const Plot& plot);
std::string make_x_range(const Plot& plot, const Extent& x);
// Integers get integer ticks; few, or on a logarithmic scale, exactly those that have points.
// `labelled`: with numbers, not of a panel that shares them with the one below.
std::string make_x_ticks(const Plot& plot, const Extent& x, bool labelled = true);
// With ticks where gnuplot would set too few.
std::string make_y_range(const Plot& plot, const Extent& x, const Extent& y);
// Of the lower panel, with its ticks.
std::string make_difference_range(const Extent& difference);

}  // namespace laboratory

// Axes of plots: ranges, scales and ticks in gnuplot's language.
#pragma once

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "experiments/laboratory/plot/plot.hpp"
#include "experiments/laboratory/plot/plot_layout.hpp"

namespace laboratory {

struct Dot {
  double x, y;
};

/// The points of a series that the upper panel can show. Throws std::invalid_argument with the
/// plot's name if the series has different numbers of x and y.
std::vector<Dot> upper_points(const Plot& plot, const Series& series);
/// The points of a series in the lower panel, whose scale is always linear.
std::vector<Dot> lower_points(const Plot& plot, const Series& series);

struct Extent {
  double low = INFINITY, high = -INFINITY;
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

/// The ranges of the points, which determine the axes.
struct Axes {
  Extent x, y, difference;
  /// x of all points of the upper panel, except those of laws and histograms
  std::set<double> marks;
  bool is_doubling = false;  ///< true if x is logarithmic with ticks at powers of two
};

Axes measure_axes(const Plot& plot);

/// Widths beside the panels: y label and numbers on the left, half of the last number on the right.
struct Margins {
  double left, right;
};
Margins find_margins(const Plot& plot, const Axes& axes, const PlotSize& size);
/// The drawn length of the x axis.
double find_x_length(const Plot& plot, const Axes& axes, const PlotSize& size);
/// Breaks the label of a y axis of this height into lines.
std::vector<std::string> break_y_label(const std::string& label, double height,
                                       const PlotSize& size);

/// Sets logarithmic scales.
std::string make_scales(const Plot& plot, const Axes& axes);
std::string make_x_range(const Plot& plot, const Extent& x);
/// Sets the ticks of x. `labelled` is false for an upper panel, whose numbers are below the lower
/// panel.
std::string make_x_ticks(const Plot& plot, const Axes& axes, const PlotSize& size, bool labelled);
std::string make_y_range(const Plot& plot, const Axes& axes);
/// Sets the y range of the lower panel. It includes 0.
std::string make_difference_range(const Extent& difference);

}  // namespace laboratory

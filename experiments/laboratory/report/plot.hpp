// Curves over a sweep: the data of a plot, and the plots of a table of results.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/laboratory/table/axis_values.hpp"
#include "experiments/laboratory/table/table.hpp"
#include "experiments/laboratory/uncertain/confidence.hpp"

namespace laboratory {

enum class SeriesKind {
  curve,      ///< points joined by lines
  reference,  ///< external numbers: points without a line
  law,        ///< a thin line through a curve, without points
  mark,       ///< rings around points of a curve
};

struct Series {
  std::string name;          ///< text in the key; "": not in the key
  std::vector<double> x, y;  ///< of equal length; non-finite points are left out
  SeriesKind kind = SeriesKind::curve;
  /// Index of this series' curve among the plot's curves: it takes that curve's colour and symbol.
  /// Unused for curves.
  std::size_t of = 0;
  RowList rows = {};        ///< rows of the table of a curve's points
  std::string column = {};  ///< the column of that table for y; "" if there is none
  /// Interval of 90 % of the machines at each point of a curve; empty without drawn machines.
  std::vector<double> low = {}, high = {};
  std::string fitted = {};  ///< result of a fit, after the name in the key: "s = 0.01 ± 0.02"

  std::string key() const;  ///< name and fit
};

struct Plot {
  std::string name;  ///< stem of the files
  std::string title, x_label, y_label;
  std::vector<Series> series;
  std::vector<Series> differences = {};  ///< a panel below over the same x; each names its curve
  std::string difference_label = {};     ///< the y axis of that panel
  bool ideal_line = false;               ///< y = x, dashed, named "ideal"
  bool is_speedup = false;               ///< y over the number of processors x
  bool log_x = false, log_y = false;
  std::optional<double> y_min, y_max;  ///< absent: determined by the points
};

/// Makes the standard plots of a sweep from the columns with values: time_s, time_per_ray_ms,
/// speedup (with the ideal line) and efficiency (0 to 1.05). As x it takes the axis "workers" if
/// that varies, else the first numeric axis that does; without one there are no plots. Each
/// combination of the other axes that vary independently of x is a series ("tree, 200 objects").
/// The title names the constant axes. Points are sorted by x.
std::vector<Plot> make_plots(const Table& table);

/// Makes a plot of each of these columns instead. Both scales are logarithmic if the values of both
/// axes span more than a decade.
std::vector<Plot> make_plots(const Table& table, const std::vector<std::string>& columns);

/// True if the scale of x is to be logarithmic: the largest value is at least 16 times the
/// smallest, for workers 32 times.
bool wants_log_x(const std::string& column, const std::vector<double>& values);

/// The axes that distinguish the series over x: they vary in these rows, are not part of x, and are
/// not determined by it. `x` lists the axes of x.
std::vector<std::size_t> choose_series_axes(const Table& table, const RowList& rows,
                                            const std::vector<std::size_t>& x);

/// Adds a point of a row to the series of that name, which is made if missing.
void add_point(std::vector<Series>& all, const std::string& name, std::size_t row, double x,
               double y);

/// Adds a band to each curve whose column has intervals; its width is zero if all machines agree.
void add_bands(Plot& plot, const Table& table, const ConfidenceTables& confidence);

/// Sorts the points of each series by x; equal ones keep their order.
void sort_points(std::vector<Series>& all);

}  // namespace laboratory

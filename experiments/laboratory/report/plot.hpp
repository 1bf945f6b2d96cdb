// Curves over a sweep: what a plot shows, and the plots that a table of results asks for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/laboratory/table/axis_values.hpp"
#include "experiments/laboratory/table/table.hpp"
#include "experiments/laboratory/uncertain/sureness.hpp"

namespace laboratory {

enum class SeriesKind {
  curve,      ///< points joined by lines
  reference,  ///< numbers from elsewhere: points without a line
  law,        ///< a thin line through a curve, without points
  mark,       ///< rings around points of a curve
};

struct Series {
  std::string name;          ///< text in the key; "" leaves it out of the key
  std::vector<double> x, y;  ///< of equal length; points that are not finite are left out
  SeriesKind kind = SeriesKind::curve;
  /// Index, among the plot's curves, of the one that this series belongs to: it has that curve's
  /// colour and symbol. It means nothing for a curve.
  std::size_t of = 0;
  RowList rows = {};        ///< of the table, where the points of a curve come from one
  std::string column = {};  ///< the column of that table that y is; "" where it is none
  /// Where nine of ten machines are, around each point of a curve; empty where none were drawn.
  std::vector<double> low = {}, high = {};
  std::string fitted = {};  ///< result of a fit, behind the name in the key: "s = 0.01 ± 0.02"

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
  std::optional<double> y_min, y_max;  ///< not given: as the points ask for
};

/// Makes the standard plots of a sweep: time_s, time_per_ray_ms, speedup (with the ideal line) and
/// efficiency (0 to 1.05), as far as these columns have values. x is the axis "workers" if it takes
/// more than one value, else the first numeric axis that does; without one there are no plots. Each
/// combination of the other axes that vary, but not with x, is a series ("tree, 200 objects"); the
/// title names the axes that do not vary. Points come in the order of x.
std::vector<Plot> make_plots(const Table& table);

/// Makes a plot of each of these columns instead. Both scales are logarithmic where the values of
/// both span more than a decade.
std::vector<Plot> make_plots(const Table& table, const std::vector<std::string>& columns);

/// Whether the scale of x is to be logarithmic: where the largest value is at least 16 times the
/// smallest, for workers 32 times.
bool wants_log_x(const std::string& column, const std::vector<double>& values);

/// The axes that tell the series over x apart: those that vary in these rows, but neither
/// make up x nor follow from it. `x` are the axes that x is made of.
std::vector<std::size_t> choose_series_axes(const Table& table, const RowList& rows,
                                            const std::vector<std::size_t>& x);

/// Adds a point of a row to the series of that name, which is made where there is none.
void add_point(std::vector<Series>& all, const std::string& name, std::size_t row, double x,
               double y);

/// Gives the curves of columns with intervals their bands; where all machines say the same a band
/// has no width.
void add_bands(Plot& plot, const Table& table, const SurenessTables& sureness);

/// Sorts the points of each series by x; equal ones keep their order.
void sort_points(std::vector<Series>& all);

}  // namespace laboratory

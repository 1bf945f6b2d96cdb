// Data of plots: curves over a sweep, and the default plots of a table of results.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/laboratory/table/axis_values.hpp"
#include "experiments/laboratory/table/samples.hpp"
#include "experiments/laboratory/table/table.hpp"
#include "experiments/laboratory/uncertain/confidence.hpp"
#include "simulator/programs/declare/program.hpp"

namespace laboratory {

enum class SeriesKind {
  curve,      ///< points joined by lines
  reference,  ///< published values: points without a line
  law,        ///< thin line of a fitted law, without points
  mark,       ///< rings around points of a curve
};

struct Series {
  std::string name;  ///< name in the legend; "": not in the legend
  /// coordinates of the points, equally many; non-finite points are not drawn
  std::vector<double> x, y;
  SeriesKind kind = SeriesKind::curve;
  /// Index of the curve that this series belongs to and shares colour and symbol with. Unused for
  /// curves.
  std::size_t of = 0;
  RowList rows = {};  ///< for a curve: the table row of each point; of a mean, its first sample
  std::string column = {};  ///< for a curve: the table column of y; "": none
  /// For a curve: the ends of an interval at each point; empty without intervals. They contain 90 %
  /// of randomly drawn machines, or are confidence intervals of means over seeds.
  std::vector<double> low = {}, high = {};
  bool has_bars = false;  ///< true: the intervals are drawn as error bars; false: as a band
  /// for a curve of means over seeds: the samples of each point; otherwise empty
  std::vector<RowSamples> samples = {};
  /// result of a fit, shown after the name in the legend: "s = 0.01 ± 0.02"
  std::string fitted = {};

  std::string key() const;  ///< the text in the legend: name and fit
};

struct Plot {
  std::string name;  ///< file name of the plot, without extension
  std::string title, x_label, y_label;
  std::vector<Series> series;
  /// series of a lower panel with the same x axis, each with the index `of` of its curve
  std::vector<Series> differences = {};
  std::string difference_label = {};  ///< label of the lower panel's y axis
  std::optional<double> level = {};   ///< adds a dashed horizontal line at this y
  bool ideal_line = false;            ///< adds y = x, dashed, named "ideal"
  bool is_speedup = false;            ///< true for speed-up over the number of processors
  bool log_x = false, log_y = false;
  std::optional<double> y_min, y_max;  ///< range of the y axis; absent: chosen from the points
};

/// Makes the default plots of a program's sweep from the columns that have values. speedup has the
/// ideal line, and efficiency at least the range 0 to 1.05. The x axis is "workers" if that
/// varies, else the first numeric axis that varies. Without one there are no plots. Each
/// combination of the other axes that vary independently of x is a series ("tree, 200 objects").
/// The title names the constant axes. Points are sorted by x.
std::vector<Plot> make_plots(const Table& table, const std::vector<programs::UsualPlot>& usual);

/// Makes a plot of each given column. Both scales are logarithmic if the values on both axes span
/// more than a decade.
std::vector<Plot> make_plots(const Table& table, const std::vector<std::string>& columns);

/// Makes plots of the growth of pictures, from the table growth.csv, with a curve for each point.
/// Points that differ only in the seed share a curve of means, whose samples are interpolated
/// linearly in time; a finished picture stays as it is. None if growth was not recorded.
std::vector<Plot> plot_growth(const Table& growth);

/// True if the scale of x should be logarithmic: the largest value is at least 16 times the
/// smallest, or 32 times for workers.
bool wants_log_x(const std::string& column, const std::vector<double>& values);

/// Chooses the axes that distinguish the series. They vary in these rows, are not part of x, and
/// are not determined by x. `x` lists the axes of x.
std::vector<std::size_t> choose_series_axes(const Table& table, const RowList& rows,
                                            const std::vector<std::size_t>& x);

/// Adds the point of a row to the series of that name. Makes the series if it is missing.
void add_point(std::vector<Series>& all, const std::string& name, std::size_t row, double x,
               double y);

/// Replaces points that differ only in the seed by their mean, with a 95 % confidence interval.
void average_points(std::vector<Series>& all, const Table& table);

/// Adds a band to each curve without error bars whose column has intervals. The band has zero width
/// where all machines agree.
void add_bands(Plot& plot, const Table& table, const ConfidenceTables& confidence);

/// Sorts the points of each series by x. Points with equal x keep their order.
void sort_points(std::vector<Series>& all);

}  // namespace laboratory

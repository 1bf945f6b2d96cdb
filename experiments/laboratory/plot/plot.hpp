// Data of plots: curves over the values of an axis, and the default plots of a results table.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/figure/figure_style.hpp"
#include "experiments/laboratory/table/axis_values.hpp"
#include "experiments/laboratory/table/samples.hpp"
#include "experiments/laboratory/table/table.hpp"
#include "experiments/laboratory/uncertain/confidence.hpp"
#include "simulator/programs/declare/program.hpp"

namespace laboratory {

enum class SeriesKind {
  curve,      ///< points joined by lines
  reference,  ///< published values: points without a line
  law,        ///< thin line of a fitted law, without symbols
  mark,       ///< rings around points of a curve
  saturated,  ///< points of a curve beyond saturation: its symbol, hollow
};

struct Series {
  std::string name;  ///< complete name, for sentences; "": not in the legend
  /// coordinates of the points, equally many; non-finite points are not drawn
  std::vector<double> x, y;
  SeriesKind kind = SeriesKind::curve;
  /// Index of the curve that this series belongs to, and whose colour and symbol it has. Unused if
  /// the series is itself a curve.
  std::size_t of = 0;
  /// for a curve: the table row of each point; for a mean over seeds, the row of its first sample
  RowList rows = {};
  std::string column = {};  ///< for a curve: the table column of y; "": y is an expression
  /// For a curve: the ends of an interval at each point; empty without intervals. An interval
  /// either contains 90 % of the results on randomly drawn machines, or is the confidence interval
  /// of a mean over seeds.
  std::vector<double> low = {}, high = {};
  bool is_stepped = false;  ///< for a curve: steps of a histogram, without symbols
  /// how intervals are drawn: true: as error bars; false: as a band along the curve
  bool has_bars = false;
  /// for a curve of means over seeds: the samples of each point; else empty
  std::vector<RowSamples> samples = {};
  /// result of a fit, which follows the name in the legend: "s = 0.01 ± 0.02"
  std::string fitted = {};
  /// name in a legend whose title names the axes: "50" for "50 objects"; "": `name`
  std::string label = {};

  const std::string& short_name() const { return label.empty() ? name : label; }
  std::string key() const;  ///< the text in the legend: short name and fit
};

struct Plot {
  std::string name;  ///< file name of the plot, without extension
  std::string title, x_label, y_label;
  std::vector<Series> series;
  /// series of a lower panel with the same x axis; `of` is the index of the curve that each belongs
  /// to
  std::vector<Series> differences = {};
  std::string difference_label = {};  ///< label of the lower panel's y axis
  std::optional<double> level = {};   ///< y of an additional dashed horizontal line
  bool ideal_line = false;            ///< true: adds the dashed line y = x with the name "ideal"
  /// true if the plot shows speed-up over the number of processors
  bool is_speedup = false;
  bool log_x = false, log_y = false;
  std::optional<double> y_min, y_max;  ///< range of the y axis; absent: chosen from the points
  std::string legend_title = {};       ///< axes that distinguish the series: "topology, objects"
  base::FigureStyle figure = {};       ///< size of the plot's figure; without a width: no figure
};

/// Makes the default plots of a program, for those of its columns that have values. The plot of the
/// speed-up has the ideal line, and that of the efficiency shows at least the range 0 to 1.05. The
/// x axis is "workers" if it varies, else the first numeric axis that varies. If no numeric axis
/// varies, there are no plots. Each combination of values of the other axes is a series ("tree, 200
/// objects"), except axes that x determines. The title lists the axes with a single value. Points
/// are sorted by x.
std::vector<Plot> make_plots(const Table& table, const std::vector<programs::UsualPlot>& usual);

/// Makes a plot of each given column. Both scales are logarithmic if the largest value on each axis
/// is more than ten times the smallest.
std::vector<Plot> make_plots(const Table& table, const std::vector<std::string>& columns);

/// Makes plots of how the picture grows with time, from the table of growth.csv, with a curve for
/// each point. Points that differ only in the seed share a curve of means. For means, values are
/// interpolated linearly in time; a finished picture keeps its last value. Empty if growth was not
/// recorded.
std::vector<Plot> plot_growth(const Table& growth);

/// True if x should have a logarithmic scale: if the largest value is at least 16 times the
/// smallest, or 32 times for the column "workers".
bool wants_log_x(const std::string& column, const std::vector<double>& values);

/// Chooses the axes that distinguish the series. They vary in these rows, are not part of x, and
/// are not determined by x and the axes before them. `x` lists the axes of x.
std::vector<std::size_t> choose_series_axes(const Table& table, const RowList& rows,
                                            const std::vector<std::size_t>& x);

/// Adds a point, from the given row, to the series with this name. Makes the series if it is
/// missing.
void add_point(std::vector<Series>& all, const std::string& name, std::size_t row, double x,
               double y);

/// Gives the curves short labels, which are their values of these axes. Returns the names of the
/// axes, which are the title of the legend.
std::string label_series(std::vector<Series>& all, const Table& table,
                         const std::vector<std::size_t>& axes);

/// Replaces points that differ only in the seed by their mean, with a 95 % confidence interval.
void average_points(std::vector<Series>& all, const Table& table);

/// Adds a band to each curve that has no error bars and whose column has intervals. Where all drawn
/// machines give the same result, the band has zero width.
void add_bands(Plot& plot, const Table& table, const ConfidenceTables& confidence);

/// Sorts the points of each series by x. Points with equal x keep their order.
void sort_points(std::vector<Series>& all);

}  // namespace laboratory

// Curves over a sweep, drawn by gnuplot.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/laboratory/table/table.hpp"

namespace laboratory {

enum class SeriesKind {
  curve,      ///< points joined by lines
  reference,  ///< numbers from elsewhere: points without a line
  law,        ///< a thin line through a curve, without points
  mark,       ///< rings around points of a curve
};

struct Series {
  std::string name;          ///< in the key; "" for none
  std::vector<double> x, y;  ///< as many of one as of the other; points not finite are left out
  SeriesKind kind = SeriesKind::curve;
  /// What is no curve wears the colour of this one, by its place in the plot; if not given, of the
  /// curve that its name contains ("3200 objects, thesis"), else of the one at the same place
  /// among its kind.
  std::optional<std::size_t> of = {};
};

struct Plot {
  std::string name;  ///< the files' stem
  std::string title, x_label, y_label;
  std::vector<Series> series;
  std::vector<Series> differences = {};  ///< in a panel below, over the same x; each `of` a curve
  std::string difference_label = {};
  bool ideal_line = false;  ///< y = x, dashed, named "ideal"
  bool log_x = false, log_y = false;
  std::optional<double> y_min, y_max;  ///< none: as the data ask for
};

/// The standard plots of a sweep: of time_s, time_per_ray_ms, speedup (with the ideal line) and
/// efficiency (0 to 1.05), those that have values. x is the axis "workers" if it takes more than
/// one value, else the first numeric axis that does; without one there are no plots. A series per
/// combination of the other axes that vary ("tree, 200 objects"), but not with x; the title names
/// the axes that do not. Points come in the order of x.
std::vector<Plot> make_plots(const Table& table);

/// Of these columns instead. Both scales are logarithmic where the values of both span more than
/// a decade.
std::vector<Plot> make_plots(const Table& table, const std::vector<std::string>& columns);

/// Whether a scale of x is to be logarithmic: workers from a span of 32, others from one of 16.
bool wants_log_x(const std::string& column, const std::vector<double>& values);

/// Points into the order of x.
void sort_by_x(Series& series);

/// Writes NAME.svg (800 x 500, higher for a long key or a second panel) and NAME.png (twice that)
/// into an existing folder; the bytes depend on the plot and on gnuplot's version and fonts only.
/// std::invalid_argument, naming the plot, for one without points or with a name that is no file
/// stem; std::runtime_error when gnuplot is not installed or fails; std::system_error when a file
/// cannot be written.
void draw_plot(const Plot& plot, const std::filesystem::path& folder);

/// Each of them, side by side on this host's processors; throws the first plot's exception.
void draw_plots(const std::vector<Plot>& plots, const std::filesystem::path& folder);

/// How high the drawing is, for a width of 800.
int choose_height(const Plot& plot);

/// Whether there is something to draw: a finite point, above 0 on a logarithmic scale.
bool has_points(const Plot& plot);

/// The plot in gnuplot's language, without terminal and output. std::invalid_argument as draw_plot.
std::string make_gnuplot_script(const Plot& plot);

}  // namespace laboratory

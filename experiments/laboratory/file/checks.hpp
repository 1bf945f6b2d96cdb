#pragma once
// Parts of an experiment file that evaluate and present results: [let], [[check]], [[baseline]],
// [[plot]], [[best]] and [report].
#include <optional>
#include <string>
#include <vector>

#include "base/fields.hpp"
#include "base/figure/figure_style.hpp"

namespace laboratory {

/// A name for an expression, such as [let] t_start = "channel.blocked / cpu.clock". Expressions may
/// refer to other rows of the results table as {COLUMN @ AXIS = VALUE, ...} (see expression.hpp).
struct Definition {
  std::string name, formula;
  std::string place;  ///< position for errors, "e.toml:9: let.t_start"
};

/// One [[check]]: compares a column of the results with a formula, a reference table or bounds.
/// Empty strings stand for absent keys.
struct Check {
  std::string name;
  std::string place;       ///< position for errors, "e.toml:12: check \"NAME\""
  std::string of;          ///< the checked value: a column of the results, or a name of [let]
  std::string formula;     ///< the expected value at each point, as an expression
  base::Source reference;  ///< a CSV file with expected values
  std::vector<std::string> keys;  ///< columns of the reference that identify a point
  std::string column;             ///< column of the reference that has the expected values
  std::string at_least, at_most;  ///< inclusive bounds, as expressions
  std::string where;              ///< expression; the check covers only points where it is not 0
  /// expression; points where it is not 0 were used to fit the machine model, and are marked as
  /// such
  std::string calibrated;
  std::optional<double> within;       ///< largest allowed relative error at any point
  std::optional<double> within_mean;  ///< largest allowed mean of the relative errors
  std::optional<double> within_abs;   ///< largest allowed absolute error, in the column's unit
  /// least share of expected values, 0 to 1, that must lie in the 90 % intervals of the results on
  /// machines drawn at random from [uncertain]
  std::optional<double> covers;
  bool may_be_empty = false;  ///< true: the check holds even if it applies to no point

  bool has_bounds() const { return !at_least.empty() || !at_most.empty(); }
  /// True if errors are in the column's unit, false if they are relative to the expected value.
  bool is_absolute() const { return within_abs.has_value() || has_bounds(); }
};

/// One [[baseline]]: adds a column with the speed-up of each row over a baseline row of the same
/// sweep.
struct BaselineSpec {
  std::string name;   ///< the NAME in the name of the added column, "speedup_NAME"
  std::string place;  ///< position for errors, "e.toml:12: baseline \"NAME\""
  /// conditions that select the baseline row: AXIS = VALUE, ..., as in {COLUMN @ AXIS = VALUE, ...}
  std::string at;
  /// column to compare; the speed-up is its value in the baseline row / its value in the row
  std::string of = "time_s";

  std::string column() const { return "speedup_" + name; }
};

/// The keys that give a plot's figure, a drawing for a paper, its size and font. An absent key of a
/// [[plot]] has its value from [report], else its default.
struct FigureSpec {
  std::string width;                ///< "column", "page" or "none"; "": absent
  std::string font;                 ///< name of a font family; "": absent
  std::optional<double> font_size;  ///< font size in points

  /// The style of the figure. Absent keys have their values from `common`. Without a width, there
  /// is no figure.
  base::FigureStyle make_style(const FigureSpec& common) const;
  bool is_given() const { return !width.empty() || !font.empty() || font_size; }
  /// Replaces each key that `other` has by its value in `other`.
  void override_with(const FigureSpec& other);
};

/// The fields of a FigureSpec, as options.
const base::Fields<FigureSpec>& figure_fields();

enum class PlotKind {
  curves,     ///< y over x
  histogram,  ///< shares of the values of x in bins
};

enum class Law { none, amdahl, gustafson, sun_ni, log };

/// One [[plot]]. Its columns may also be names from [let], or expressions.
struct PlotSpec {
  std::string name;   ///< file name of the plot, without extension
  std::string place;  ///< position for errors, "e.toml:12: plot \"NAME\""
  PlotKind kind = PlotKind::curves;
  std::string title;
  std::string x;               ///< for a histogram: a quantity of histogram.csv
  std::vector<std::string> y;  ///< columns on the y axis, at least one; none for a histogram
  /// axes whose values distinguish curves; no value: all axes that vary, except x
  std::optional<std::vector<std::string>> series;
  std::string where;   ///< expression; only points where it is not 0 are plotted; "": all points
  bool ideal = false;  ///< adds the line y = x
  std::optional<bool> log_x, log_y;
  std::string x_label, y_label;
  base::Source reference;         ///< a CSV file with values to plot beside the results
  std::vector<std::string> keys;  ///< columns of the reference that identify a point
  std::string column;             ///< column of the reference that is plotted
  std::string reference_name;     ///< name of the reference in the plot's legend
  Law fit = Law::none;
  /// expression for G(n), the growth of the work with n processors in Sun and Ni's law
  std::string growth;
  bool optimum = false;  ///< marks the largest y of each curve
  FigureSpec figure;     ///< size and font of the plot's figure
};

/// One [[best]]: finds the values of the axes `over` that optimise `of`, separately for each
/// combination of values of `for_each`. Results for several seeds are averaged before the
/// comparison. Means count as equally good if their difference may be due to chance.
struct BestSpec {
  std::string name;
  std::string place;  ///< position for errors, "e.toml:12: best \"NAME\""
  /// the quantity to optimise: a column, a name from [let] or an expression
  std::string of;
  bool least = true;              ///< true: minimises `of`; false: maximises it
  std::vector<std::string> over;  ///< axes whose values compete
  /// axes whose values are separate cases, each with its own best
  std::vector<std::string> for_each;
  std::string where;
  /// numeric axis; also finds the value up to which each doubling improves `of` by at least `gain`
  std::string pays;
  double gain = 0.1;  ///< least relative improvement for which a doubling pays
};

/// The section [report].
struct ReportSpec {
  std::string networks = "none";  ///< networks to draw with their loads: "all", "largest" or "none"
  std::vector<std::string> columns = {};  ///< result columns to show beside the axes, or "all"
  FigureSpec figure = {};                 ///< size and font of all figures
};

}  // namespace laboratory

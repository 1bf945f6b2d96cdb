#pragma once
// The parts of an experiment file that judge and show results: [let], [[check]], [[plot]], [[best]]
// and [report].
#include <optional>
#include <string>
#include <vector>

namespace laboratory {

/// A name for an expression: [let] t_start = "channel.blocked / cpu.clock". Expressions may refer
/// to other rows of the sweep as {COLUMN @ AXIS = VALUE, ...}, see expression.hpp.
struct Definition {
  std::string name, formula;
  std::string place;  ///< "e.toml:9: let.t_start"
};

/// One [[check]]: compares a column of the results with a formula, a reference table or bounds.
/// Empty texts stand for absent keys.
struct Check {
  std::string name;
  std::string place;              ///< "e.toml:12: check \"NAME\""
  std::string of;                 ///< a column of the results, or a name of [let]
  std::string formula;            ///< the expected value at each point; or
  std::string reference;          ///< the path of a CSV file,
  std::vector<std::string> keys;  ///< its columns that identify the point, and
  std::string column;             ///< its column of values; or
  std::string at_least, at_most;  ///< the bounds, expressions; inclusive
  std::string where;              ///< only points with a non-zero value of this
  std::string calibrated;        ///< the machine was fitted to points with a non-zero value of this
  std::optional<double> within;  ///< largest relative error at any point,
  std::optional<double> within_mean;  ///< and on average over the points;
  std::optional<double> within_abs;   ///< or largest absolute error, in the column's unit
  std::optional<double> covers;       ///< least share of expected values inside
                                      ///< the 90 % intervals of the drawn machines

  bool has_bounds() const { return !at_least.empty() || !at_most.empty(); }
  /// True if errors are in the column's unit; otherwise they are relative to the expected value.
  bool is_absolute() const { return within_abs.has_value() || has_bounds(); }
};

/// One [[baseline]]: a column with each row's speed relative to another row of the same sweep.
struct BaselineSpec {
  std::string name;           ///< of the column, "speedup_NAME"
  std::string place;          ///< "e.toml:12: baseline \"NAME\""
  std::string at;             ///< the baseline row: AXIS = VALUE, ..., as in {COLUMN @ ...}
  std::string of = "time_s";  ///< the column to compare: its value there / the own value

  std::string column() const { return "speedup_" + name; }
};

enum class Law { none, amdahl, gustafson, sun_ni, log };

/// One [[plot]]. As in a [[check]], columns may also be names of [let] or expressions.
struct PlotSpec {
  std::string name;   ///< stem of its files
  std::string place;  ///< "e.toml:12: plot \"NAME\""
  std::string title;
  std::string x;
  std::vector<std::string> y;  ///< one or several, each with its own curves
  /// Axes with a curve for each combination of values; absent: all that vary, except x.
  std::optional<std::vector<std::string>> series;
  std::string where;   ///< only points with a non-zero value of this; "": all
  bool ideal = false;  ///< add the line y = x
  std::optional<bool> log_x, log_y;
  std::string x_label, y_label;
  std::string reference;          ///< path of a CSV file with reference values,
  std::vector<std::string> keys;  ///< its columns that identify the point,
  std::string column;             ///< its column of values,
  std::string reference_name;     ///< and their name in the plot's key
  Law fit = Law::none;
  std::string growth;    ///< G(n) of Sun and Ni's law
  bool optimum = false;  ///< mark the largest y of each curve
};

/// One [[best]]: for each value of some axes, the value of other axes with the best `of`.
struct BestSpec {
  std::string name;
  std::string place;                  ///< "e.toml:12: best \"NAME\""
  std::string of;                     ///< a column, a name of [let] or an expression
  bool least = true;                  ///< the least is best; else the most
  std::vector<std::string> over;      ///< axes with competing values
  std::vector<std::string> for_each;  ///< axes whose values are separate cases
  std::string where;
  std::string pays;   ///< an axis: find how far doubling it gains
  double gain = 0.1;  ///< at least this share
};

/// [report]
struct ReportSpec {
  std::string networks = "none";          ///< drawn with their load: "all", "largest" or "none"
  std::vector<std::string> columns = {};  ///< columns to show beside the axes; "all"
};

}  // namespace laboratory

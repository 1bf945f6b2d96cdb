#pragma once
// What the results of an experiment are compared with, and what its report shows: [let], [[check]],
// [[plot]], [[best]] and [report] of its file.
#include <optional>
#include <string>
#include <vector>

namespace laboratory {

/// A name for an expression: [let] t_start = "channel.blocked / cpu.clock". Expressions may use
/// numbers of other rows of the sweep, {COLUMN @ AXIS = VALUE, ...}: expression.hpp.
struct Definition {
  std::string name, formula;
  std::string place;  ///< "e.toml:9: let.t_start"
};

/// One [[check]]: a column of the results against a formula, a table of numbers or bounds. Empty
/// texts stand for keys that the file does not have.
struct Check {
  std::string name;
  std::string place;                  ///< "e.toml:12: check \"NAME\""
  std::string of;                     ///< the column of the results, or a name of [let]
  std::string formula;                ///< what it should be at each point; or
  std::string reference;              ///< the path of a CSV file,
  std::vector<std::string> keys;      ///< its columns that say which point a row is for, and
  std::string column;                 ///< the one with the value; or
  std::string at_least, at_most;      ///< the bounds, expressions; a value may be equal to them
  std::string where;                  ///< only points where this is not zero
  std::string calibrated;             ///< the machine was fitted to points where this is not zero
  std::optional<double> within;       ///< largest relative error, at worst,
  std::optional<double> within_mean;  ///< and on average over the points;
  std::optional<double> within_abs;   ///< or largest absolute error, in the column's unit
  std::optional<double> covers;       ///< where machines are drawn: at least that share of what is
                                      ///< expected lies where nine of ten machines are

  bool has_bounds() const { return !at_least.empty() || !at_most.empty(); }
  /// Whether errors are in the column's unit; else they are relative to what was expected.
  bool is_absolute() const { return within_abs.has_value() || has_bounds(); }
};

/// One [[baseline]]: a column of how many times as fast each row is as another of the same sweep.
struct BaselineSpec {
  std::string name;           ///< of the column, "speedup_NAME"
  std::string place;          ///< "e.toml:12: baseline \"NAME\""
  std::string at;             ///< the row: AXIS = VALUE, ..., as in {COLUMN @ ...}
  std::string of = "time_s";  ///< the column that is compared, its value there by the row's own

  std::string column() const { return "speedup_" + name; }
};

enum class Law { none, amdahl, gustafson, sun_ni, log };

/// One [[plot]]. Columns may also be names of [let] or expressions, as in a [[check]].
struct PlotSpec {
  std::string name;   ///< stem of its files
  std::string place;  ///< "e.toml:12: plot \"NAME\""
  std::string title;
  std::string x;
  std::vector<std::string> y;  ///< one, or several, each with its curves
  /// Axes, with one curve for each of their values; not given: those that vary apart from x.
  std::optional<std::vector<std::string>> series;
  std::string where;   ///< only points where this is not zero; "": all
  bool ideal = false;  ///< with the line y = x
  std::optional<bool> log_x, log_y;
  std::string x_label, y_label;
  std::string reference;          ///< path of a CSV file with numbers from elsewhere,
  std::vector<std::string> keys;  ///< its columns that say which point a row is for,
  std::string column;             ///< the one with the value,
  std::string reference_name;     ///< and what the key calls them
  Law fit = Law::none;
  std::string growth;    ///< G(n) of Sun and Ni's law
  bool optimum = false;  ///< marks the largest y of each curve
};

/// One [[best]]: for each value of some axes the value of others at which `of` is best.
struct BestSpec {
  std::string name;
  std::string place;                  ///< "e.toml:12: best \"NAME\""
  std::string of;                     ///< a column, a name of [let] or an expression
  bool least = true;                  ///< the least of it is best; else the most
  std::vector<std::string> over;      ///< axes with values that compete,
  std::vector<std::string> for_each;  ///< and those with values for each of which they do
  std::string where;
  std::string pays;   ///< an axis: up to where doubling it gains
  double gain = 0.1;  ///< at least that share
};

/// [report]
struct ReportSpec {
  std::string networks = "none";          ///< drawn with their load: "all", "largest" or "none"
  std::vector<std::string> columns = {};  ///< of the table that is shown, beside the axes; "all"
};

}  // namespace laboratory

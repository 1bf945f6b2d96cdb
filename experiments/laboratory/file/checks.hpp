#pragma once
// What the results of an experiment are compared with: [[check]] and [let] of its file.
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

  bool has_bounds() const { return !at_least.empty() || !at_most.empty(); }
  /// Whether errors are in the column's unit; else they are relative to what was expected.
  bool is_absolute() const { return within_abs.has_value() || has_bounds(); }
};

}  // namespace laboratory

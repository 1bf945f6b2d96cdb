#pragma once
// Uncertainty of results: the intervals of the results over randomly drawn machines, and the model
// entries that cause the uncertainty.
#include <initializer_list>
#include <string>
#include <vector>

#include "experiments/laboratory/table/table.hpp"

namespace laboratory {

/// Distribution of a result over randomly drawn machines.
struct Interval {
  std::size_t row, column;       ///< row and column of the result in the table of the nominal model
  double value;                  ///< result of the nominal model
  double low, median, high;      ///< quantiles over the machines: 5 %, 50 % and 95 %
  std::vector<double> machines;  ///< result on each machine
};

/// Finds the interval of each numeric cell that is not an axis, exists on all machines, and is not
/// the same on all of them. `machines` has one table for each machine. Rows of the tables are
/// matched by the values of their axes.
std::vector<Interval> find_intervals(const Table& table, const std::vector<Table>& machines);

/// The influence of one model entry on a result.
struct Influence {
  std::string entry;
  double swing;  ///< change of the result when the entry moves from 5 % to 95 % of its range
  double error;  ///< standard error of the swing
  /// Spearman's rank correlation of the entry with the residuals of a fit. The fit uses only the
  /// entries that were selected before this entry.
  double correlation;
};

/// Selects the entries that affect a result, by stepwise regression, and sorts them by swing. Each
/// step fits the result linearly to the entries selected so far, and adds the entry that has the
/// strongest rank correlation with the residuals. Stops when entries without any effect would reach
/// this correlation in more than 5 % of cases. `quantiles` has, for each entry, its quantile on
/// each machine. Throws BadInput for fewer than three machines.
std::vector<Influence> find_influences(const std::vector<double>& results,
                                       const std::vector<std::string>& entries,
                                       const std::vector<std::vector<double>>& quantiles);

/// Makes a table without rows that has the axes of `table`, then these columns.
Table start_table(const Table& table, std::initializer_list<const char*> columns);
/// The cells of a row's axes.
std::vector<Value> take_axes(const Table& table, std::size_t row);

/// Makes intervals.csv, with one row for each interval: first its axes, then its numbers.
Table make_intervals_table(const Table& table, const std::vector<Interval>& intervals);

}  // namespace laboratory

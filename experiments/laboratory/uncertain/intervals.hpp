#pragma once
// Uncertainty of results: their intervals over many machines, and the entries that cause them.
#include <initializer_list>
#include <string>
#include <vector>

#include "experiments/laboratory/table/table.hpp"

namespace laboratory {

/// A result's distribution over the drawn machines.
struct Interval {
  std::size_t row, column;       ///< in the table of the nominal model
  double value;                  ///< in that cell
  double low, median, high;      ///< the quantiles 5, 50 and 95 % of the machines
  std::vector<double> machines;  ///< the result on each
};

/// Finds the interval of each numeric cell that is not an axis, exists on all machines and varies.
/// `machines` holds a table for each; their rows are matched by their axes.
std::vector<Interval> find_intervals(const Table& table, const std::vector<Table>& machines);

/// The influence of one entry on a result.
struct Influence {
  std::string entry;
  double swing;        ///< change of the result from 5 to 95 % of the entry's range
  double error;        ///< its standard error
  double correlation;  ///< by ranks (Spearman), with the residual of the entries before
};

/// Stepwise selection of the entries that affect a result, sorted by swing. Each step adds the
/// entry with the strongest rank correlation with the residual of a linear fit on the chosen
/// entries. It stops at a correlation that entries without effect would reach in more than one
/// result of twenty. `quantiles` holds those of each entry, by machine. Throws BadInput for fewer
/// than three machines.
std::vector<Influence> find_influences(const std::vector<double>& results,
                                       const std::vector<std::string>& entries,
                                       const std::vector<std::vector<double>>& quantiles);

/// A table without rows: the axes of `table`, followed by these columns.
Table start_table(const Table& table, std::initializer_list<const char*> columns);
/// The cells of a row's axes.
std::vector<Value> take_axes(const Table& table, std::size_t row);

/// intervals.csv: a line for each, the axes first.
Table make_intervals_table(const Table& table, const std::vector<Interval>& intervals);

}  // namespace laboratory

#pragma once
// How sure results are: where they lie over many machines, and which number decides it.
#include <initializer_list>
#include <string>
#include <vector>

#include "experiments/laboratory/table/table.hpp"

namespace laboratory {

/// What a result is on the machines that were drawn.
struct Interval {
  std::size_t row, column;       ///< of the table of the model as it stands
  double value;                  ///< there
  double low, median, high;      ///< 5, 50 and 95 % of the machines are not above it
  std::vector<double> machines;  ///< the result on each
};

/// Finds the interval of each numeric cell that is no axis, that all machines have and that is not
/// the same on all. `machines` holds a table for each; their rows are matched by their axes.
std::vector<Interval> find_intervals(const Table& table, const std::vector<Table>& machines);

/// How much one entry decides of a result.
struct Influence {
  std::string entry;
  double swing;        ///< what the result changes from 5 to 95 % of the entry's range
  double error;        ///< its standard error
  double correlation;  ///< of ranks (Spearman), with what the entries found before leave over
};

/// The entries that move a result, those with the widest swing first: the one that correlates most
/// with the result, then the one that correlates most with what a plane through those chosen leaves
/// over, and so on, while a correlation is so strong that entries that do nothing would show one
/// like it in one result of twenty at most. `quantiles` holds those of each entry, by machine.
/// Throws BadInput for fewer than three machines.
std::vector<Influence> find_influences(const std::vector<double>& results,
                                       const std::vector<std::string>& entries,
                                       const std::vector<std::vector<double>>& quantiles);

/// A table without rows: the axes of `table`, and these columns behind them.
Table start_table(const Table& table, std::initializer_list<const char*> columns);
/// The cells of a row's axes.
std::vector<Value> take_axes(const Table& table, std::size_t row);

/// intervals.csv: a line for each, the axes first.
Table make_intervals_table(const Table& table, const std::vector<Interval>& intervals);

}  // namespace laboratory

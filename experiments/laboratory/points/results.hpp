#pragma once
// From the points of a sweep to one table.
#include <set>

#include "experiments/laboratory/points/point_result.hpp"
#include "experiments/laboratory/table/table.hpp"

namespace laboratory {

/// The columns that say which point a row is: those that the program puts first (the farm's
/// topology, workers and objects), then the axes of the sweep in the order of the file, in which
/// the number of the network's processors is called as the program calls it.
std::vector<std::string> axis_columns(const ExperimentFile& file);

/// The columns of the axes that go with that of `column` in [sweep], itself too; only itself where
/// none do.
std::vector<std::string> find_coupled(const ExperimentFile& file, const std::string& column);

/// A row for each that the result of a point has, one for a point that has none: the axes; the
/// parts of its program, which count as axes; the network and the parameters, where the program
/// shows them and they are no axes; what was measured; and how the point ended. Where the sweep's
/// points run several programs, the columns are those of all of them, empty where they do not
/// apply. Speed-up and efficiency are relative to the row with one processor and otherwise the same
/// axes, or to PointResult::single_s; they stay empty where there is neither, and beside them the
/// serial fractions of laws.hpp.
Table make_table(const ExperimentFile& file, const Results& results);

/// The rows of growth.csv: the axes, and how each point's picture grew. Empty where nothing was
/// looked at.
Table make_growth_table(const ExperimentFile& file, const Results& results);

/// Whether the row's point came to its end.
bool is_complete_row(const Table& table, const std::vector<Value>& row);

/// Fills the columns speedup and efficiency where they are empty: relative to the row with one
/// processor and otherwise the same axes. `processors` is the column of an axis.
void add_speedups(Table& table, const std::string& processors);

/// Fills serial_karp_flatt and serial_gustafson (laws.hpp) for every speed-up.
void add_serial_fractions(Table& table, const std::string& processors);

/// The names of columns that are inputs: the axes, the network's, and the programs' parameters.
std::set<std::string> input_names(const ExperimentFile& file, const Table& table);

/// The first column of such a table that is a result and not an input as well; none if all are.
std::vector<std::string> first_result(const ExperimentFile& file, const Table& table);

/// Whether all points run the farm.
bool is_farm(const ExperimentFile& file);
/// A coordinate as a cell.
Value to_value(const Coordinate& at);

}  // namespace laboratory

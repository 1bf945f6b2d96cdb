#pragma once
// Table of the results of all points of a sweep.
#include <set>

#include "experiments/laboratory/points/point_result.hpp"
#include "experiments/laboratory/table/table.hpp"

namespace laboratory {

/// The columns that identify a point. Those of the program come first (the farm's topology, workers
/// and objects), then the axes of the sweep in file order. The program names the column of the
/// network's size.
std::vector<std::string> axis_columns(const ExperimentFile& file);

/// The columns of the axes coupled with `column` in [sweep], including `column` itself.
std::vector<std::string> find_coupled(const ExperimentFile& file, const std::string& column);

/// Makes the table of results, with one row for each row that a point measured, or one for a point
/// that measured nothing. Columns are:
///   - the axes, and the columns that a program declares as its parts, which count as axes;
///   - network and parameters, if the program shows them;
///   - the measurements, and how the point ended.
/// With several programs in the sweep, the table has the columns of all, empty where they do not
/// apply. Speed-up and efficiency are relative to the row with one processor and otherwise equal
/// axes, or to PointResult::single_s. If both are missing, they stay empty, and so do the serial
/// fractions of laws.hpp.
Table make_table(const ExperimentFile& file, const Results& results);

/// Makes growth.csv: the axes, and the growth of each point's picture. Empty if growth was not
/// recorded.
Table make_growth_table(const ExperimentFile& file, const Results& results);

/// True if the point of the row was completed.
bool is_complete_row(const Table& table, const std::vector<Value>& row);

/// Fills empty cells of speed-up and efficiency, relative to the row with one processor and
/// otherwise equal axes. `processors` is the name of the column with the number of processors.
void add_speedups(Table& table, const std::string& processors);

/// Fills serial_karp_flatt and serial_gustafson (laws.hpp) in each row with a speed-up.
void add_serial_fractions(Table& table, const std::string& processors);

/// The names of input columns: axes, properties of the network, and parameters of the programs.
std::set<std::string> input_names(const ExperimentFile& file, const Table& table);

/// The first column of a results table that is a result and not an input; none if all are inputs.
std::vector<std::string> first_result(const ExperimentFile& file, const Table& table);

/// What the program of all points shows of its results; the defaults if there are several programs.
const programs::Shows& shows_of(const ExperimentFile& file);
Value to_value(const Coordinate& at);

}  // namespace laboratory

#pragma once
// Combines the results of a sweep's points in one table.
#include <set>

#include "experiments/laboratory/points/point_result.hpp"
#include "experiments/laboratory/table/table.hpp"

namespace laboratory {

/// The columns that identify a point: first those of the program (the farm's topology, workers and
/// objects), then the axes of the sweep in file order. The program chooses the name of the number
/// of processors in the network.
std::vector<std::string> axis_columns(const ExperimentFile& file);

/// The columns of axes coupled with `column` in [sweep], including itself; only itself if there are
/// none.
std::vector<std::string> find_coupled(const ExperimentFile& file, const std::string& column);

/// Makes a row for each row of a point's result, or one for a point without. Columns are the axes;
/// the parts of its program, which count as axes; the network and parameters, if the program shows
/// them; the measurements; and how the point ended. With several programs in the sweep, the columns
/// are those of all, empty where not applicable. Speed-up and efficiency relate to the row with one
/// processor and otherwise equal axes, or to PointResult::single_s. Without either they stay empty,
/// as do the serial fractions of laws.hpp.
Table make_table(const ExperimentFile& file, const Results& results);

/// The rows of growth.csv: the axes, and the growth of each point's picture. Empty if growth was
/// not observed.
Table make_growth_table(const ExperimentFile& file, const Results& results);

/// True if the row's point was completed.
bool is_complete_row(const Table& table, const std::vector<Value>& row);

/// Fills empty cells of speedup and efficiency, relative to the row with one processor and
/// otherwise equal axes. `processors` is the column of an axis.
void add_speedups(Table& table, const std::string& processors);

/// Fills serial_karp_flatt and serial_gustafson (laws.hpp) for every speed-up.
void add_serial_fractions(Table& table, const std::string& processors);

/// The names of input columns: the axes, the network's, and the programs' parameters.
std::set<std::string> input_names(const ExperimentFile& file, const Table& table);

/// The first column of such a table that is a result and not also an input; none if all are inputs.
std::vector<std::string> first_result(const ExperimentFile& file, const Table& table);

/// True if all points run the farm.
bool is_farm(const ExperimentFile& file);
/// A coordinate as a cell.
Value to_value(const Coordinate& at);

}  // namespace laboratory

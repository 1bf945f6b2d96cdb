#pragma once
// The table of the results of all points of a sweep.
#include <set>

#include "experiments/laboratory/points/point_result.hpp"
#include "experiments/laboratory/table/table.hpp"

namespace laboratory {

/// The columns that identify a point. Those that the program declares come first, such as the
/// farm's topology, workers and objects. Then come the axes of the sweep, in the order of the file.
/// The program also gives the name of the column for the size of the network.
std::vector<std::string> axis_columns(const ExperimentFile& file);

/// The columns of the axes that change together with `column` in [sweep], including `column`.
std::vector<std::string> find_coupled(const ExperimentFile& file, const std::string& column);

/// The names of all columns that the results of the file may have, known before the simulation.
/// "stage{}_s" stands for the columns stage1_s, stage2_s and so on. Excludes columns of
/// [[baseline]].
std::vector<std::string> declared_columns(const ExperimentFile& file);

/// True if a name is among declared_columns().
bool is_declared(const std::vector<std::string>& declared, const std::string& name);

/// Makes the results table. A point has one row for each row that its simulation measured, or one
/// row if nothing was measured. The columns are
///   - the axes, and the columns by which a program divides its results into parts, which count as
///     axes;
///   - the network and the parameters, if the program shows them;
///   - the measured results, and `ended`, which tells how the point ended.
/// With several programs in the sweep, the table has the columns of all programs; cells are empty
/// where a column does not apply. Speed-up and efficiency are relative to the row with one
/// processor and otherwise equal axes. If there is no such row, they are relative to
/// PointResult::single_s. Without this value, they stay empty, and so do the serial fractions (see
/// laws.hpp).
Table make_table(const ExperimentFile& file, const Results& results);

/// Makes a table of the axes and of further rows of each point: of growth.csv (how its picture grew
/// with simulated time) or histogram.csv. Empty if no point has such rows.
Table make_table_of(std::vector<base::Row> PointResult::*rows, const ExperimentFile& file,
                    const Results& results);

/// True if the point that the row belongs to was completed.
bool is_complete_row(const Table& table, const std::vector<Value>& row);

/// Fills empty cells of speed-up and efficiency, relative to the row with one processor and
/// otherwise equal axes. `processors` is the name of the column with the number of processors.
void add_speedups(Table& table, const std::string& processors);

/// Fills the columns serial_karp_flatt and serial_gustafson (see laws.hpp) in rows with a speed-up.
void add_serial_fractions(Table& table, const std::string& processors);

/// The names of input columns: axes, properties of the network, and parameters of the programs.
std::set<std::string> input_names(const ExperimentFile& file, const Table& table);

/// The first column that is a result and not an input, as a list; empty if all columns are inputs.
std::vector<std::string> first_result(const ExperimentFile& file, const Table& table);
/// The default plots that all programs of the file share.
std::vector<programs::UsualPlot> find_common_plots(const ExperimentFile& file);

/// The quantities of which programs of the file make histograms.
std::vector<std::string> find_histograms(const ExperimentFile& file);

/// The columns of saturation that all programs of the file share; no value if they differ.
std::optional<programs::SaturationColumns> find_common_saturation(const ExperimentFile& file);

/// The columns and plots that the program of all points shows; the defaults if the points run
/// several programs.
const programs::Shows& shows_of(const ExperimentFile& file);
Value to_value(const Coordinate& at);

}  // namespace laboratory

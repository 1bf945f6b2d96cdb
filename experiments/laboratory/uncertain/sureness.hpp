#pragma once
// What the machines that were drawn say of an experiment's results.
#include <filesystem>
#include <optional>

#include "experiments/laboratory/points/point_result.hpp"
#include "experiments/laboratory/uncertain/intervals.hpp"

namespace laboratory {

struct Sureness {
  std::vector<Interval> intervals;
  std::vector<std::string> entries;            ///< that were drawn
  std::vector<std::vector<double>> quantiles;  ///< of each entry, by machine
  std::size_t machines = 0;                    ///< that have all points done
  std::size_t left_out = 0;                    ///< that have not
};

constexpr std::size_t LEAST_MACHINES = 3;

/// `table` is that of the file's own points; `results` are of all points of the spread file. There
/// are no intervals where fewer than LEAST_MACHINES have all their points.
Sureness find_sureness(const ExperimentFile& file, const Table& table, const Results& results);

/// How sure the results are, as two tables of the results folder.
struct SurenessTables {
  Table intervals;    ///< intervals.csv, see make_intervals_table
  Table assumptions;  ///< assumptions.csv: for each result the entries that matter most, the
                      ///< strongest first
};
SurenessTables make_sureness_tables(const Table& table, const Sureness& sureness);
void save_sureness(const std::filesystem::path& folder, const SurenessTables& tables);
/// None where no machines were drawn. Throws BadInput for damaged files.
std::optional<SurenessTables> load_sureness(const std::filesystem::path& folder);

/// From 5 to 95 % of the machines, of a cell of the table of results; none where there is no such
/// interval.
std::optional<std::pair<double, double>> find_interval(const SurenessTables& sureness,
                                                       const Table& table, std::size_t row,
                                                       const std::string& column);

/// How much an entry matters for a column.
struct Weight {
  std::string entry;
  double share;      ///< half of what the result changes from 5 to 95 % of the entry's range, of
                     ///< the result; the median of the rows
  std::size_t rows;  ///< in so many it is among the strongest
};
/// Those that are among the strongest in most rows first, and of them the strongest.
std::vector<Weight> weigh(const SurenessTables& sureness, const std::string& column);

/// A sentence for each of these columns that has intervals: how wide they are, and which entries
/// matter most, five at most.
std::vector<std::string> tell_sureness(const SurenessTables& sureness,
                                       const std::vector<std::string>& columns);

}  // namespace laboratory

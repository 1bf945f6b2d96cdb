#pragma once
// Confidence in an experiment's results, from the drawn machines.
#include <filesystem>
#include <optional>

#include "experiments/laboratory/points/point_result.hpp"
#include "experiments/laboratory/uncertain/intervals.hpp"

namespace laboratory {

struct Confidence {
  std::vector<Interval> intervals;
  std::vector<std::string> entries;            ///< entries that were drawn
  std::vector<std::vector<double>> quantiles;  ///< of each entry, by machine
  std::size_t machines = 0;                    ///< with all points done
  std::size_t left_out = 0;                    ///< with incomplete points
};

constexpr std::size_t LEAST_MACHINES = 3;

/// `table` is that of the file's own points; `results` are of all points of the spread file. There
/// are no intervals if fewer than LEAST_MACHINES machines have all their points.
Confidence find_confidence(const ExperimentFile& file, const Table& table, const Results& results);

/// The confidence in the results, as two tables of the results folder.
struct ConfidenceTables {
  Table intervals;    ///< intervals.csv, see make_intervals_table
  Table assumptions;  ///< assumptions.csv: for each result the most influential entries, the
                      ///< strongest first
};
ConfidenceTables make_confidence_tables(const Table& table, const Confidence& confidence);
void save_confidence(const std::filesystem::path& folder, const ConfidenceTables& tables);
/// None without drawn machines. Throws BadInput for damaged files.
std::optional<ConfidenceTables> load_confidence(const std::filesystem::path& folder);

/// The interval from 5 to 95 % of the machines, for a cell of the table of results; none if it has
/// no interval.
std::optional<std::pair<double, double>> find_interval(const ConfidenceTables& confidence,
                                                       const Table& table, std::size_t row,
                                                       const std::string& column);

/// The influence of an entry on a column.
struct Weight {
  std::string entry;
  double share;  ///< half the change of the result from 5 to 95 % of the entry's range, relative to
                 ///< the result; the median of the rows
  std::size_t rows;  ///< number of rows with this entry among the strongest
};
/// Sorted by the number of rows, then by share.
std::vector<Weight> weigh(const ConfidenceTables& confidence, const std::string& column);

/// A sentence for each of these columns with intervals: their width, and the most influential
/// entries, five at most.
std::vector<std::string> describe_confidence(const ConfidenceTables& confidence,
                                             const std::vector<std::string>& columns);

}  // namespace laboratory

#pragma once
// Uncertainty of an experiment's results, found by simulating machines drawn at random.
#include <filesystem>
#include <optional>

#include "experiments/laboratory/points/point_result.hpp"
#include "experiments/laboratory/uncertain/intervals.hpp"

namespace laboratory {

struct Confidence {
  std::vector<Interval> intervals;
  /// names of the model entries that were drawn at random
  std::vector<std::string> entries;
  std::vector<std::vector<double>> quantiles;  ///< for each entry, its quantile on each machine
  std::size_t machines = 0;                    ///< number of machines that completed all points
  std::size_t left_out = 0;                    ///< number of machines with incomplete points
};

constexpr std::size_t LEAST_MACHINES = 3;

/// Evaluates the results on the randomly drawn machines. `table` has only the points of the nominal
/// model; `results` also has those of the drawn machines. Finds no intervals if fewer than
/// LEAST_MACHINES machines have completed all their points.
Confidence find_confidence(const ExperimentFile& file, const Table& table, const Results& results);

/// The files of the results folder that describe the uncertainty of the results.
struct ConfidenceTables {
  Table intervals;  ///< intervals.csv (see make_intervals_table)
  /// assumptions.csv: for each result, the model entries that influence it most, strongest first
  Table assumptions;
};
ConfidenceTables make_confidence_tables(const Table& table, const Confidence& confidence);
void save_confidence(const std::filesystem::path& folder, const ConfidenceTables& tables);
/// Loads the tables; no value if no machines were drawn. Throws BadInput for damaged files.
std::optional<ConfidenceTables> load_confidence(const std::filesystem::path& folder);

/// The interval of a cell of the results table: the 5 % and 95 % quantiles over the machines. No
/// value if the cell has no interval.
std::optional<std::pair<double, double>> find_interval(const ConfidenceTables& confidence,
                                                       const Table& table, std::size_t row,
                                                       const std::string& column);

/// How strongly a model entry influences the results in a column.
struct Weight {
  std::string entry;
  /// Half of the result's relative change when the entry moves from 5 % to 95 % of its range; the
  /// median over the rows of the table.
  double share;
  std::size_t rows;  ///< number of rows in which the entry is among the strongest influences
};
/// Lists the entries that influence a column, sorted by the number of rows, then by share.
std::vector<Weight> weigh(const ConfidenceTables& confidence, const std::string& column);

/// Makes a sentence for each of these columns that has intervals: how wide they are, and up to five
/// entries that influence them most.
std::vector<std::string> describe_confidence(const ConfidenceTables& confidence,
                                             const std::vector<std::string>& columns);

}  // namespace laboratory

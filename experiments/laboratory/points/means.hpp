#pragma once
// Means of results over several seeds.
#include "experiments/laboratory/file/experiment.hpp"
#include "experiments/laboratory/table/table.hpp"

namespace laboratory {

/// End of the name of a column with half widths of confidence intervals: "time_s ±".
inline constexpr const char* HALF_WIDTH = " ±";
/// Name of the column with the number of averaged samples.
inline constexpr const char* SEEDS = "seeds";

/// Averages the rows that differ only in the seed. Returns the table unchanged if no seed has
/// several values. Otherwise:
///   - the column "seeds", the number of samples, replaces the seed's column;
///   - numeric results become means over the completed points;
///   - for each result whose samples differ, a column "NAME ±" is appended, with the half width of
///     the 95 % confidence interval (Student's t);
///   - texts that differ between samples become empty;
///   - `ended`, which tells how a simulation ended, is that of the first incomplete point.
/// Each row belongs to the point of its first sample.
Table average_seeds(const Table& table);

/// Describes the means to the reader of a table: "Means over seed = 1, 2, 3; ± is half ...", or
/// that the seed has no effect. Returns "" if no seed has several values.
std::string describe_seeds(const Table& table);

/// Makes means.csv. It has one row for each group of samples and numeric result: the number of
/// samples, their mean and standard deviation, and the ends of the 95 % confidence interval. Empty
/// if no seed has several values.
Table make_means_csv(const ExperimentFile& file, const Table& table);

}  // namespace laboratory

#pragma once
// Means of results over seeds.
#include "experiments/laboratory/file/experiment.hpp"
#include "experiments/laboratory/table/table.hpp"

namespace laboratory {

/// Ending of the name of a column with half widths: "time_s ±".
inline constexpr const char* HALF_WIDTH = " ±";
/// Name of the column with the number of samples.
inline constexpr const char* SEEDS = "seeds";

/// Averages the rows that differ only in the seed. A table without a seed that has several values
/// is returned unchanged. Otherwise the seed's column is replaced by the column `seeds`, the number
/// of samples. Numeric results are means over the completed points. For each result whose samples
/// differ, a last column "NAME ±" has the half width of the 95 % confidence interval (Student's t).
/// Texts that differ between samples are empty. `ended` is that of the first incomplete point. Each
/// row belongs to the point of its first sample.
Table average_seeds(const Table& table);

/// Describes the means for the reader of a table: "Means over seed = 1, 2, 3; ± is half ...". Says
/// so if the seed has no effect. "" without a seed that has several values.
std::string describe_seeds(const Table& table);

/// Makes means.csv: for each group of rows and each numeric result (not an input), its number of
/// samples, mean, standard deviation, and the ends of the 95 % confidence interval. Empty without a
/// seed that has several values.
Table make_means_csv(const ExperimentFile& file, const Table& table);

}  // namespace laboratory

#pragma once
// Means of random results, and the confidence intervals of these means. The samples of a result are
// the rows of a table that differ only in the seed.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/laboratory/table/axis_values.hpp"
#include "experiments/laboratory/table/table.hpp"

namespace laboratory {

/// True for the axis name "seed" and for names that end with "_seed".
bool is_seed(std::string_view axis);

/// The indices of axes that are seeds and have several values.
std::vector<std::size_t> find_seeds(const Table& table);

/// Groups the rows that have equal values on all axes except seeds. The order of the groups is the
/// order of their first rows. If no seed has several values, each row is a group of its own.
std::vector<RowList> group_samples(const Table& table, const RowList& rows);
/// For each row of the table, the number of its group, from 0.
std::vector<std::size_t> number_samples(const Table& table);

/// Formats the values of the seeds: "seed = 1, 2, 3"; "" if no seed has several values.
std::string name_seeds(const Table& table);

/// A mean or a difference of means, with its 95 % confidence interval by Student's t distribution.
struct MeanInterval {
  double mean = 0;
  std::size_t samples = 0;
  /// half the width of the interval; no value for fewer than two samples
  std::optional<double> half_width = {};

  double low() const { return mean - half_width.value_or(0); }
  double high() const { return mean + half_width.value_or(0); }
  /// True if the interval contains the value.
  bool contains(double value) const { return low() <= value && value <= high(); }
};

/// The mean of independent samples. Throws std::invalid_argument if there are none.
MeanInterval find_mean_interval(const std::vector<double>& samples);
/// The mean of b - a for samples in pairs. Pairing removes random effects that both samples of a
/// pair share. The vectors have equal length.
MeanInterval find_paired_difference(const std::vector<double>& a, const std::vector<double>& b);
/// The difference of the means, mean(b) - mean(a), for independent samples, with Welch's interval
/// for unequal variances. `samples` of the result is the smaller number of samples.
MeanInterval find_difference(const std::vector<double>& a, const std::vector<double>& b);

/// values of a result in the rows of a group
struct RowSamples {
  RowList rows;
  std::vector<double> values;
};
/// The difference of the means, b - a. If both groups have the same seeds, pairs the samples that
/// have equal seeds.
MeanInterval compare_samples(const Table& table, const RowSamples& a, const RowSamples& b);

}  // namespace laboratory

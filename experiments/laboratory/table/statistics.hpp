#pragma once
// Statistics of samples, and quantiles of distributions.
#include <vector>

namespace laboratory {

/// Mean, median, variance and deviation throw std::invalid_argument for too few samples: mean and
/// median need at least one, variance and deviation at least two.
double find_mean(const std::vector<double>& samples);
double find_median(std::vector<double> samples);
double find_variance(const std::vector<double>& samples);  ///< sample variance, divided by n - 1
double find_deviation(const std::vector<double>& samples);

/// The quantile of samples in ascending order. The first sample is the quantile for `share` = 0,
/// the last for `share` = 1. Interpolates linearly between samples.
double find_quantile(const std::vector<double>& ascending, double share);
/// Spearman's rank correlation. Equal values share their mean rank. NaN if all values of a or of b
/// are equal.
double correlate_ranks(const std::vector<double>& a, const std::vector<double>& b);

/// The value below which a Student's t variable lies with the probability `below`.
double student_t(double below, double degrees_of_freedom);
/// The value below which a standard normal variable lies with the probability `below`.
double normal_quantile(double below);

}  // namespace laboratory

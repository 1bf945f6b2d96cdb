#pragma once
// Statistics of samples, and quantiles of distributions.
#include <vector>

namespace laboratory {

/// Mean, median, variance and deviation throw std::invalid_argument for too few samples: none, or
/// fewer than two for variance and deviation.
double find_mean(const std::vector<double>& samples);
double find_median(std::vector<double> samples);
double find_variance(const std::vector<double>& samples);  ///< sample variance, divided by n - 1
double find_deviation(const std::vector<double>& samples);

/// Quantile of ascending samples. `share` is 0 for the first sample and 1 for the last.
/// Interpolates linearly between samples.
double find_quantile(const std::vector<double>& ascending, double share);
/// Spearman's rank correlation. Equal samples share their mean rank. NaN if a sample is constant.
double correlate_ranks(const std::vector<double>& a, const std::vector<double>& b);

/// Quantile of Student's t distribution for the probability `below`.
double student_t(double below, double degrees_of_freedom);
/// The same for the standard normal distribution.
double normal_quantile(double below);

}  // namespace laboratory

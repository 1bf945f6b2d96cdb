#pragma once
// Statistics of samples, the only interface to GSL's statistics.
#include <vector>

namespace laboratory {

/// These functions throw std::invalid_argument for too few samples: none, or fewer than two for
/// variance and deviation.
double find_mean(const std::vector<double>& samples);
double find_median(std::vector<double> samples);
double find_variance(const std::vector<double>& samples);  ///< sample variance, divided by n - 1
double find_deviation(const std::vector<double>& samples);

/// Quantile of Student's t distribution for the probability `below`.
double student_t(double below, double degrees_of_freedom);

}  // namespace laboratory

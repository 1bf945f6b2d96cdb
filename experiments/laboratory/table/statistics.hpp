#pragma once
// Statistics of samples: the only interface to GSL's statistics.
#include <vector>

namespace laboratory {

/// All throw std::invalid_argument for fewer samples than required: one, or two for variance and
/// deviation.
double find_mean(const std::vector<double>& samples);
double find_median(std::vector<double> samples);
double find_variance(const std::vector<double>& samples);  ///< divided by n - 1
double find_deviation(const std::vector<double>& samples);

/// Student's t: the quantile of the probability `below`.
double student_t(double below, double degrees_of_freedom);

}  // namespace laboratory

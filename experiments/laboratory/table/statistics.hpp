#pragma once
// What samples tell: the door to GSL's statistics.
#include <vector>

namespace laboratory {

/// All throw std::invalid_argument for fewer samples than they need: one, variance and deviation
/// two.
double find_mean(const std::vector<double>& samples);
double find_median(std::vector<double> samples);
double find_variance(const std::vector<double>& samples);  ///< of n - 1
double find_deviation(const std::vector<double>& samples);

/// Student's t: the value below which a share `below` of the distribution is.
double student_t(double below, double degrees_of_freedom);

}  // namespace laboratory

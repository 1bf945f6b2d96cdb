#include "experiments/laboratory/table/statistics.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_statistics_double.h>

#include <cmath>
#include <stdexcept>

namespace laboratory {
namespace {

void check_count(const std::vector<double>& samples, std::size_t least) {
  if (samples.size() < least) throw std::invalid_argument("too few samples");
}

}  // namespace

double find_mean(const std::vector<double>& samples) {
  check_count(samples, 1);
  return gsl_stats_mean(samples.data(), 1, samples.size());
}

double find_median(std::vector<double> samples) {
  check_count(samples, 1);
  return gsl_stats_median(samples.data(), 1, samples.size());
}

double find_variance(const std::vector<double>& samples) {
  check_count(samples, 2);
  return gsl_stats_variance(samples.data(), 1, samples.size());
}

double find_deviation(const std::vector<double>& samples) {
  return std::sqrt(find_variance(samples));
}

double student_t(double below, double degrees_of_freedom) {
  return gsl_cdf_tdist_Pinv(below, degrees_of_freedom);
}

}  // namespace laboratory

#include "experiments/laboratory/table/statistics.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "experiments/laboratory/table/linear_fit.hpp"

namespace laboratory {
namespace {

void check_count(const std::vector<double>& samples, std::size_t least) {
  if (samples.size() < least) throw std::invalid_argument("too few samples");
}

// The rank of each sample, from 1; equal samples share their mean rank.
std::vector<double> rank(const std::vector<double>& samples) {
  std::vector<std::size_t> order(samples.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return samples[i]; });
  std::vector<double> ranks(samples.size());
  for (std::size_t first = 0, end = 0; first < order.size(); first = end) {
    while (end < order.size() && samples[order[end]] == samples[order[first]]) ++end;
    for (std::size_t k = first; k < end; ++k)
      ranks[order[k]] = static_cast<double>(first + end + 1) / 2;
  }
  return ranks;
}

}  // namespace

double find_mean(const std::vector<double>& samples) {
  check_count(samples, 1);
  long double mean = 0, count = 0;
  for (const double sample : samples) mean += (sample - mean) / ++count;
  return static_cast<double>(mean);
}

double find_median(std::vector<double> samples) {
  check_count(samples, 1);
  std::ranges::sort(samples);
  return find_quantile(samples, 0.5);
}

double find_variance(const std::vector<double>& samples) {
  check_count(samples, 2);
  const double mean = find_mean(samples);
  long double variance = 0, count = 0;
  for (const double sample : samples) {
    const long double delta = sample - mean;
    variance += (delta * delta - variance) / ++count;
  }
  const auto n = static_cast<double>(samples.size());
  return static_cast<double>(variance) * (n / (n - 1));
}

double find_deviation(const std::vector<double>& samples) {
  return std::sqrt(find_variance(samples));
}

double find_quantile(const std::vector<double>& ascending, double share) {
  check_count(ascending, 1);
  const double place = share * static_cast<double>(ascending.size() - 1);
  const auto low = static_cast<std::size_t>(place);
  if (low + 1 == ascending.size()) return ascending[low];
  const double rest = place - static_cast<double>(low);
  return (1 - rest) * ascending[low] + rest * ascending[low + 1];
}

double correlate_ranks(const std::vector<double>& a, const std::vector<double>& b) {
  auto x = rank(a), y = rank(b);
  const double middle = static_cast<double>(a.size() + 1) / 2;
  for (double& value : x) value -= middle;
  for (double& value : y) value -= middle;
  return dot(x, y) / (std::sqrt(dot(x, x)) * std::sqrt(dot(y, y)));
}

double student_t(double below, double degrees_of_freedom) {
  return quantile(boost::math::students_t(degrees_of_freedom), below);
}

double normal_quantile(double below) { return quantile(boost::math::normal(), below); }

}  // namespace laboratory

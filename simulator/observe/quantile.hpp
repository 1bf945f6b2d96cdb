#pragma once
// Quantiles of samples.
#include <cstddef>
#include <vector>

#include "base/errors.hpp"

namespace observe {

/// The quantile of samples in ascending order. The first sample is the quantile for `share` = 0,
/// the last for `share` = 1. Interpolates linearly between samples. Throws InvariantBroken without
/// samples.
inline double find_quantile(const std::vector<double>& ascending, double share) {
  if (ascending.empty()) throw base::InvariantBroken("a quantile of no samples");
  const double place = share * static_cast<double>(ascending.size() - 1);
  const auto low = static_cast<std::size_t>(place);
  if (low + 1 == ascending.size()) return ascending[low];
  const double rest = place - static_cast<double>(low);
  return (1 - rest) * ascending[low] + rest * ascending[low + 1];
}

}  // namespace observe

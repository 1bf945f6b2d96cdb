#pragma once
// Means of quantities that may not have occurred.
#include <optional>

namespace observe {

/// `sum` divided by `count`, or nothing if `count` is 0; a table then shows an empty cell. `count`
/// may also be a total of which `sum` is a part.
inline std::optional<double> eval_mean(double sum, double count) {
  return count > 0 ? std::optional(sum / count) : std::nullopt;
}

}  // namespace observe

#pragma once
// Means that may not exist.
#include <optional>

namespace observe {

/// `sum` divided by `count`; none if `count` is 0, which gives an empty cell in a table. `count` is
/// a number of things, or a total of which `sum` is a part.
inline std::optional<double> eval_mean(double sum, double count) {
  return count > 0 ? std::optional(sum / count) : std::nullopt;
}

}  // namespace observe

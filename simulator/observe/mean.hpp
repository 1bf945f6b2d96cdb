#pragma once
// Means that may not exist.
#include <optional>

namespace observe {

/// `sum` over `count`, a number of things or the whole of a share; none if `count` is 0. In a table
/// the cell is then empty.
inline std::optional<double> eval_mean(double sum, double count) {
  return count > 0 ? std::optional(sum / count) : std::nullopt;
}

}  // namespace observe

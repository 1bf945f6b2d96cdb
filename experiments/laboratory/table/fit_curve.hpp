#pragma once
// Least squares of one parameter that does not enter linearly.
#include <cstddef>
#include <functional>
#include <optional>

namespace laboratory {

struct FittedParameter {
  double value = 0, variance = 0;
  double squares = 0;  // sum of the squared residuals
};

// The parameter at which the sum of the squares of `residual(parameter, i)`, i from 0 to
// points - 1, is least, iterated from `start`; at least two points. The variance is that of the
// residuals, over points - 1, carried through the slope there. None where the iteration does not
// settle.
std::optional<FittedParameter> fit_curve(
    std::size_t points, double start,
    const std::function<double(double parameter, std::size_t i)>& residual);

}  // namespace laboratory

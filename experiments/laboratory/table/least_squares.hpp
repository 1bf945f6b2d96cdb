#pragma once
// Nonlinear least squares.
#include <cstddef>
#include <functional>
#include <stdexcept>
#include <vector>

namespace laboratory {

/// Error: the residuals do not depend on a parameter, or two parameters have the same effect.
struct Undetermined : std::runtime_error {
  explicit Undetermined(std::vector<std::size_t> which)
      : std::runtime_error("the residuals do not determine the parameters"),
        parameters(std::move(which)) {}
  std::vector<std::size_t> parameters;  ///< indices of the undetermined parameters
};

/// Error: the iteration did not converge, or a residual at the start is not finite.
struct Unsettled : std::runtime_error {
  Unsettled() : std::runtime_error("the iteration does not converge") {}
};

struct LeastSquares {
  std::vector<double> parameters;
  /// standard errors of the parameters, if the residuals are independent and of equal variance
  std::vector<double> errors;
  std::vector<double> residuals;
  double squares = 0;  ///< sum of the squared residuals
};

/// Half width of the central difference that approximates the derivative at a parameter's value. It
/// must be large against rounding errors of the model.
using Step = std::function<double(std::size_t parameter, double value)>;
using Residuals = std::function<std::vector<double>(const std::vector<double>& parameters)>;

/// Finds parameters near `start` that minimise the sum of squared residuals, by the
/// Levenberg-Marquardt method. Throws std::invalid_argument unless there are more residuals than
/// parameters, Undetermined if the residuals do not determine the parameters at some step,
/// Unsettled if the iteration does not converge, and exceptions of `residuals`.
LeastSquares fit_least_squares(const Residuals& residuals, const std::vector<double>& start,
                               const Step& step);

}  // namespace laboratory

#pragma once
// Nonlinear least squares: the only interface to GSL's nonlinear fits.
#include <cstddef>
#include <functional>
#include <stdexcept>
#include <vector>

namespace laboratory {

/// The residuals do not depend on a parameter, or two parameters have the same effect.
struct Undetermined : std::runtime_error {
  explicit Undetermined(std::vector<std::size_t> which)
      : std::runtime_error("the residuals do not determine the parameters"),
        parameters(std::move(which)) {}
  std::vector<std::size_t> parameters;  ///< indices of these parameters
};

/// The iteration does not converge.
struct Unsettled : std::runtime_error {
  Unsettled() : std::runtime_error("the iteration does not settle") {}
};

struct LeastSquares {
  std::vector<double> parameters;
  /// Their standard errors, for independent residuals of equal variance.
  std::vector<double> errors;
  std::vector<double> residuals;
  double squares = 0;  ///< sum of the squared residuals
};

/// Half width of the central difference at a parameter's value: wide enough for a model that
/// rounds.
using Step = std::function<double(std::size_t parameter, double value)>;
using Residuals = std::function<std::vector<double>(const std::vector<double>& parameters)>;

/// Finds the parameters near `start` with the least sum of squared residuals (Levenberg and
/// Marquardt). Throws std::invalid_argument unless there are more residuals than parameters,
/// Undetermined (at the start and at the end), Unsettled, and exceptions of `residuals`.
LeastSquares fit_least_squares(const Residuals& residuals, const std::vector<double>& start,
                               const Step& step);

}  // namespace laboratory

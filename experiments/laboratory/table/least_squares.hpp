#pragma once
// Parameters of a model that is no straight line over them, by least squares: the door to GSL's
// nonlinear fits.
#include <cstddef>
#include <functional>
#include <stdexcept>
#include <vector>

namespace laboratory {

/// The residuals do not depend on a parameter, or on two of them alike.
struct Undetermined : std::runtime_error {
  explicit Undetermined(std::vector<std::size_t> which)
      : std::runtime_error("the residuals do not determine the parameters"),
        parameters(std::move(which)) {}
  std::vector<std::size_t> parameters;  ///< which
};

/// The iteration finds no least squares.
struct Unsettled : std::runtime_error {
  Unsettled() : std::runtime_error("the iteration does not settle") {}
};

struct LeastSquares {
  std::vector<double> parameters;
  /// Their standard errors, if the residuals are independent and of one spread.
  std::vector<double> errors;
  std::vector<double> residuals;
  double squares = 0;  ///< sum of the squared residuals
};

/// How far a derivative looks either way of a parameter's value: wide enough for a model that
/// rounds.
using Step = std::function<double(std::size_t parameter, double value)>;
using Residuals = std::function<std::vector<double>(const std::vector<double>& parameters)>;

/// The parameters near `start` at which the squares of the residuals are least (Levenberg and
/// Marquardt). Throws std::invalid_argument unless there are more residuals than parameters,
/// Undetermined, at the start and where it ends, Unsettled, and what `residuals` throws.
LeastSquares fit_least_squares(const Residuals& residuals, const std::vector<double>& start,
                               const Step& step);

}  // namespace laboratory

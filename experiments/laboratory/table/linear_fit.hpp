#pragma once
// Linear least squares.
#include <vector>

namespace laboratory {

/// The fit of values by a sum of terms, each multiplied by a factor.
struct LinearFit {
  std::vector<double> factors;  ///< factor of each term; 0 if the term depends on earlier ones
  /// for each factor, its variance divided by the variance of a single value
  std::vector<double> spreads;
  std::vector<double> residuals;  ///< residual of each value
  double squares = 0;             ///< sum of the squared residuals

  /// The variance of a factor, if the residuals are independent and of equal variance.
  double variance(std::size_t factor) const;
};

/// Fits by modified Gram-Schmidt orthogonalisation. `terms` has one list for each term, and each
/// list has as many elements as `values`.
LinearFit fit_linear(std::vector<std::vector<double>> terms, std::vector<double> values);

double dot(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace laboratory

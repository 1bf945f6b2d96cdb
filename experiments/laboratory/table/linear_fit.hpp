#pragma once
// Linear least squares.
#include <vector>

namespace laboratory {

/// The fit of values by a sum of factors times terms.
struct LinearFit {
  std::vector<double> factors;    ///< factor of each term; 0 if it depends on earlier terms
  std::vector<double> spreads;    ///< variance of each factor divided by the variance of one value
  std::vector<double> residuals;  ///< of each value
  double squares = 0;             ///< sum of the squared residuals

  /// The factor's variance, for independent residuals of equal variance.
  double variance(std::size_t factor) const;
};

/// Fits by modified Gram-Schmidt orthogonalisation. `terms` holds one list for each term, as long
/// as `values`.
LinearFit fit_linear(std::vector<std::vector<double>> terms, std::vector<double> values);

double dot(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace laboratory

#include "experiments/laboratory/table/linear_fit.hpp"

#include <cmath>
#include <numeric>

#include "base/errors.hpp"

namespace laboratory {
namespace {

using Vector = std::vector<double>;
using Matrix = std::vector<Vector>;

// A term counts as dependent on earlier terms if the part orthogonal to them is shorter than this
// share of the term.
constexpr double DEPENDENT = 1e-12;

// Removes from `from` its component along the unit vector `direction`, and returns the length of
// this component.
double take_share(const Vector& direction, Vector& from) {
  const double share = dot(direction, from);
  for (std::size_t i = 0; i < from.size(); ++i) from[i] -= share * direction[i];
  return share;
}

// Solves an upper triangular system. Unknowns with a zero on the diagonal become 0.
Vector solve_triangle(const Matrix& upper, Vector right) {
  for (std::size_t k = right.size(); k-- > 0;) {
    for (std::size_t j = k + 1; j < right.size(); ++j) right[k] -= upper[k][j] * right[j];
    right[k] = upper[k][k] > 0 ? right[k] / upper[k][k] : 0;
  }
  return right;
}

}  // namespace

double dot(const Vector& a, const Vector& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

double LinearFit::variance(std::size_t factor) const {
  return spreads[factor] * squares / static_cast<double>(residuals.size() - factors.size());
}

LinearFit fit_linear(Matrix terms, Vector values) {
  const std::size_t count = terms.size();
  Matrix upper(count, Vector(count));
  Vector shares(count);
  Vector lengths;
  for (const auto& term : terms) {
    base::check_equal("values of a term", term.size(), values.size());
    lengths.push_back(std::sqrt(dot(term, term)));
  }
  for (std::size_t k = 0; k < count; ++k) {
    const double rest = std::sqrt(dot(terms[k], terms[k]));
    if (!(rest > DEPENDENT * lengths[k])) continue;
    upper[k][k] = rest;
    for (double& value : terms[k]) value /= rest;
    for (std::size_t j = k + 1; j < count; ++j) upper[k][j] = take_share(terms[k], terms[j]);
    shares[k] = take_share(terms[k], values);
  }
  LinearFit fit{solve_triangle(upper, shares), Vector(count), std::move(values)};
  for (std::size_t k = 0; k < count; ++k) {
    Vector unit(count);
    unit[k] = 1;
    const auto column = solve_triangle(upper, unit);  // a column of the inverse of `upper`
    for (std::size_t j = 0; j < count; ++j) fit.spreads[j] += column[j] * column[j];
  }
  fit.squares = dot(fit.residuals, fit.residuals);
  return fit;
}

}  // namespace laboratory

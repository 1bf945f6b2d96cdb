#include "experiments/laboratory/table/least_squares.hpp"

#include <algorithm>
#include <cmath>

#include "experiments/laboratory/table/linear_fit.hpp"

namespace laboratory {
namespace {

constexpr int MOST_MOVES = 200;
constexpr double TOLERANCE = 1e-10;

// the Jacobian matrix, with one column for each parameter
using Columns = std::vector<std::vector<double>>;

bool are_finite(const std::vector<double>& values) {
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

Columns eval_jacobian(const Residuals& residuals, const std::vector<double>& at, const Step& step) {
  Columns jacobian;
  for (std::size_t p = 0; p < at.size(); ++p) {
    auto below = at, above = at;
    const double half_width = step(p, at[p]);
    above[p] += half_width;
    below[p] -= half_width;
    const auto low = residuals(below), high = residuals(above);
    auto& column = jacobian.emplace_back();
    for (std::size_t i = 0; i < low.size(); ++i)
      column.push_back((high[i] - low[i]) / (above[p] - below[p]));
    if (!are_finite(column)) throw Unsettled();
  }
  return jacobian;
}

// Throws if the residuals do not determine the parameters: a column is zero, or two columns are
// parallel.
void require_determined(const Columns& jacobian) {
  constexpr double NOTHING = 1e-7, ALIKE = 0.99999;
  std::vector<double> lengths;
  for (std::size_t a = 0; a < jacobian.size(); ++a) {
    lengths.push_back(std::sqrt(dot(jacobian[a], jacobian[a])));
    if (lengths[a] < NOTHING) throw Undetermined({a});
    for (std::size_t b = 0; b < a; ++b) {
      const double product = dot(jacobian[a], jacobian[b]);
      if (std::abs(product) > ALIKE * lengths[a] * lengths[b]) throw Undetermined({b, a});
    }
  }
}

// State of the Levenberg-Marquardt iteration: the parameters `at`, and their residuals `left`.
// `scales` has, for each parameter, the greatest length so far of its column of the Jacobian.
struct Descent {
  const Residuals& residuals;
  const Step& step;
  std::vector<double> at, left, scales;
  Columns jacobian = {};
  double squares = 0, damping = 1e-3, growth = 2;
};

void differentiate(Descent& d) {
  d.jacobian = eval_jacobian(d.residuals, d.at, d.step);
  require_determined(d.jacobian);
  for (std::size_t p = 0; p < d.at.size(); ++p)
    d.scales[p] = std::max(d.scales[p], std::sqrt(dot(d.jacobian[p], d.jacobian[p])));
}

// True if the gradient of the sum of squares is zero up to TOLERANCE.
bool is_level(const Descent& d) {
  for (std::size_t p = 0; p < d.at.size(); ++p)
    if (std::abs(dot(d.jacobian[p], d.left) * std::max(d.at[p], 1.0)) >
        TOLERANCE * std::max(d.squares / 2, 1.0))
      return false;
  return true;
}

// The change of the parameters that minimises the sum
// |left + jacobian * change|^2 + damping * |scales * change|^2.
LinearFit find_move(const Descent& d) {
  auto terms = d.jacobian;
  std::vector<double> values;
  for (const double residual : d.left) values.push_back(-residual);
  values.resize(d.left.size() + d.at.size());
  for (std::size_t p = 0; p < d.at.size(); ++p) {
    terms[p].resize(values.size());
    terms[p][d.left.size() + p] = std::sqrt(d.damping) * d.scales[p];
  }
  return fit_linear(std::move(terms), std::move(values));
}

// Computes a change of the parameters, and applies it if it reduces the sum of squares. Returns
// false if the change is too small to matter.
bool try_move(Descent& d) {
  const auto move = find_move(d);
  auto next = d.at;
  bool matters = false;
  for (std::size_t p = 0; p < next.size(); ++p) {
    next[p] += move.factors[p];
    matters |= std::abs(move.factors[p]) >= TOLERANCE * (std::abs(d.at[p]) + TOLERANCE);
  }
  auto there = d.residuals(next);
  const double reached = dot(there, there);
  if (reached < d.squares) {
    const double gain = (d.squares - reached) / (d.squares - move.squares);
    // Nielsen's rule for the damping
    d.damping *= std::max(1.0 / 3, 1 - std::pow(2 * gain - 1, 3));
    d.growth = 2;
    d.at = std::move(next), d.left = std::move(there), d.squares = reached;
    differentiate(d);
  } else {
    d.damping *= d.growth;
    d.growth *= 2;
  }
  return matters;
}

}  // namespace

LeastSquares fit_least_squares(const Residuals& residuals, const std::vector<double>& start,
                               const Step& step) {
  Descent d{residuals, step, start, residuals(start), std::vector<double>(start.size())};
  if (start.empty() || d.left.size() <= start.size())
    throw std::invalid_argument("expected more residuals than parameters");
  if (!are_finite(d.left)) throw Unsettled();
  d.squares = dot(d.left, d.left);
  differentiate(d);
  for (int moves = 0; d.squares > 0 && !is_level(d) && try_move(d);)
    if (++moves == MOST_MOVES) throw Unsettled();
  LeastSquares fit{d.at, {}, d.left, d.squares};
  const double variance = d.squares / static_cast<double>(d.left.size() - d.at.size());
  for (const double spread : fit_linear(d.jacobian, d.left).spreads)
    fit.errors.push_back(std::sqrt(spread * variance));
  return fit;
}

}  // namespace laboratory

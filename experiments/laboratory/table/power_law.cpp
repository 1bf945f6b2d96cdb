#include "experiments/laboratory/table/power_law.hpp"

#include <gsl/gsl_fit.h>
#include <gsl/gsl_multifit.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include "base/errors.hpp"

namespace laboratory {
namespace {

// minimum number of points; a broken line fits almost any fewer points
constexpr std::size_t FEWEST = 5;
constexpr double LEAST_CHANGE = 0.2, MOST_LEFT = 0.25;

struct Line {
  double before, after, squares;
};

template <class T>
using Owned = std::unique_ptr<T, void (*)(T*)>;

// The logarithms of the numbers; empty unless all are positive.
std::vector<double> logs_of(const std::vector<double>& values) {
  std::vector<double> logs;
  for (const double value : values) {
    if (!std::isfinite(value) || value <= 0) return {};
    logs.push_back(std::log(value));
  }
  return logs;
}

Line fit_straight(const std::vector<double>& t, const std::vector<double>& v) {
  double a = 0, slope = 0, aa = 0, ab = 0, bb = 0, squares = 0;
  gsl_fit_linear(t.data(), 1, v.data(), 1, t.size(), &a, &slope, &aa, &ab, &bb, &squares);
  return {slope, slope, squares};
}

// Fits v = a + b t + c max(0, t - at), a line that bends at t = at.
Line fit_broken(const std::vector<double>& t, const std::vector<double>& v, double at) {
  const Owned<gsl_matrix> terms(gsl_matrix_alloc(t.size(), 3), gsl_matrix_free);
  const Owned<gsl_matrix> covariance(gsl_matrix_alloc(3, 3), gsl_matrix_free);
  const Owned<gsl_vector> factors(gsl_vector_alloc(3), gsl_vector_free);
  const Owned<gsl_multifit_linear_workspace> space(gsl_multifit_linear_alloc(t.size(), 3),
                                                   gsl_multifit_linear_free);
  for (std::size_t i = 0; i < t.size(); ++i) {
    gsl_matrix_set(terms.get(), i, 0, 1);
    gsl_matrix_set(terms.get(), i, 1, t[i]);
    gsl_matrix_set(terms.get(), i, 2, std::max(0.0, t[i] - at));
  }
  const auto values = gsl_vector_const_view_array(v.data(), v.size());
  double squares = 0;
  gsl_multifit_linear(terms.get(), &values.vector, factors.get(), covariance.get(), &squares,
                      space.get());
  const double before = gsl_vector_get(factors.get(), 1);
  return {before, before + gsl_vector_get(factors.get(), 2), squares};
}

}  // namespace

std::optional<PowerLaw> fit_power_law(const std::vector<double>& x, const std::vector<double>& y) {
  base::check_equal("points of a curve", y.size(), x.size());
  const auto t = logs_of(x), v = logs_of(y);
  const bool ascends = std::ranges::adjacent_find(t, std::greater_equal{}) == t.end();
  if (t.size() < FEWEST || v.size() < FEWEST || !ascends) return std::nullopt;
  const Line straight = fit_straight(t, v);
  PowerLaw growth{straight.before, straight.after};
  // Residuals of a straight line that are only rounding errors do not justify a bend.
  double least = std::max(MOST_LEFT * straight.squares, 1e-18 * static_cast<double>(t.size()));
  if (straight.squares <= least) return growth;
  for (std::size_t i = 1; i + 1 < t.size(); ++i) {
    const Line broken = fit_broken(t, v, t[i]);
    if (broken.squares > least || std::abs(broken.after - broken.before) < LEAST_CHANGE) continue;
    least = broken.squares;
    growth = {broken.before, broken.after, x[i]};
  }
  return growth;
}

}  // namespace laboratory

#include "experiments/laboratory/table/least_squares.hpp"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_multifit_nlinear.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>

namespace laboratory {
namespace {

constexpr std::size_t MOST_STEPS = 200;
constexpr double TOLERANCE = 1e-10;

// Disables GSL's default error handler, which ends the program, while this object lives.
struct QuietErrors {
  gsl_error_handler_t* before = gsl_set_error_handler_off();
  ~QuietErrors() { gsl_set_error_handler(before); }
};

using Matrix = std::unique_ptr<gsl_matrix, void (*)(gsl_matrix*)>;
using Workspace =
    std::unique_ptr<gsl_multifit_nlinear_workspace, void (*)(gsl_multifit_nlinear_workspace*)>;

std::vector<double> to_values(const gsl_vector& vector) {
  std::vector<double> values;
  for (std::size_t i = 0; i < vector.size; ++i) values.push_back(gsl_vector_get(&vector, i));
  return values;
}

// Callback data for GSL. Stores an exception thrown in the callback, since exceptions must not pass
// through C code.
struct Problem {
  const Residuals& residuals;
  const Step& step;
  std::exception_ptr thrown = {};

  void rethrow() const {
    if (thrown) std::rethrow_exception(thrown);
  }
};

int eval_residuals(const gsl_vector* at, void* problem_of, gsl_vector* into) {
  auto& problem = *static_cast<Problem*>(problem_of);
  try {
    const auto values = problem.residuals(to_values(*at));
    if (!std::ranges::all_of(values, [](double value) { return std::isfinite(value); }))
      return GSL_EDOM;
    for (std::size_t i = 0; i < values.size(); ++i) gsl_vector_set(into, i, values[i]);
    return GSL_SUCCESS;
  } catch (...) {
    problem.thrown = std::current_exception();
    return GSL_EBADFUNC;
  }
}

int eval_jacobian(const gsl_vector* at, void* problem_of, gsl_matrix* into) {
  auto& problem = *static_cast<Problem*>(problem_of);
  try {
    for (std::size_t p = 0; p < at->size; ++p) {
      auto below = to_values(*at), above = below;
      const double step = problem.step(p, above[p]);
      above[p] += step;
      below[p] -= step;
      const auto low = problem.residuals(below), high = problem.residuals(above);
      for (std::size_t i = 0; i < low.size(); ++i)
        gsl_matrix_set(into, i, p, (high[i] - low[i]) / (above[p] - below[p]));
    }
    return GSL_SUCCESS;
  } catch (...) {
    problem.thrown = std::current_exception();
    return GSL_EBADFUNC;
  }
}

// Throws if a column is zero or two columns are parallel.
void require_determined(const gsl_matrix& jacobian) {
  constexpr double NOTHING = 1e-7, ALIKE = 0.99999;
  std::vector<double> lengths;
  for (std::size_t a = 0; a < jacobian.size2; ++a) {
    const auto own = gsl_matrix_const_column(&jacobian, a);
    lengths.push_back(gsl_blas_dnrm2(&own.vector));
    if (lengths[a] < NOTHING) throw Undetermined({a});
    for (std::size_t b = 0; b < a; ++b) {
      const auto other = gsl_matrix_const_column(&jacobian, b);
      double product = 0;
      gsl_blas_ddot(&own.vector, &other.vector, &product);
      if (std::abs(product) > ALIKE * lengths[a] * lengths[b]) throw Undetermined({b, a});
    }
  }
}

}  // namespace

LeastSquares fit_least_squares(const Residuals& residuals, const std::vector<double>& start,
                               const Step& step) {
  const auto first = residuals(start);
  const std::size_t count = first.size();
  if (start.empty() || count <= start.size())
    throw std::invalid_argument("expected more residuals than parameters");
  const QuietErrors quiet;
  const auto how = gsl_multifit_nlinear_default_parameters();
  const Workspace work(
      gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &how, count, start.size()),
      gsl_multifit_nlinear_free);
  Problem problem{residuals, step};
  gsl_multifit_nlinear_fdf function{};
  function.f = eval_residuals;
  function.df = eval_jacobian;
  function.n = count;
  function.p = start.size();
  function.params = &problem;
  const auto at = gsl_vector_const_view_array(start.data(), start.size());
  int status = gsl_multifit_nlinear_init(&at.vector, &function, work.get());
  problem.rethrow();
  const gsl_matrix* jacobian = gsl_multifit_nlinear_jac(work.get());
  if (status == GSL_SUCCESS) require_determined(*jacobian);
  const bool is_met = std::ranges::all_of(first, [](double value) { return value == 0; });
  if (status == GSL_SUCCESS && !is_met) {
    int why = 0;
    status = gsl_multifit_nlinear_driver(MOST_STEPS, TOLERANCE, TOLERANCE, 0, nullptr, nullptr,
                                         &why, work.get());
    problem.rethrow();
    require_determined(*jacobian);
  }
  // GSL reports no progress if the start or an intermediate step was already optimal.
  if (status != GSL_SUCCESS && status != GSL_ENOPROG) throw Unsettled();
  const Matrix covariances(gsl_matrix_alloc(start.size(), start.size()), gsl_matrix_free);
  gsl_multifit_nlinear_covar(jacobian, 0, covariances.get());

  LeastSquares fit;
  fit.parameters = to_values(*gsl_multifit_nlinear_position(work.get()));
  fit.residuals = to_values(*gsl_multifit_nlinear_residual(work.get()));
  for (const double residual : fit.residuals) fit.squares += residual * residual;
  const double variance = fit.squares / static_cast<double>(count - start.size());
  for (std::size_t i = 0; i < start.size(); ++i)
    fit.errors.push_back(std::sqrt(gsl_matrix_get(covariances.get(), i, i) * variance));
  return fit;
}

}  // namespace laboratory

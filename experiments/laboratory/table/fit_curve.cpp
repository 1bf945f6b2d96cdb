#include "experiments/laboratory/table/fit_curve.hpp"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_multifit_nlinear.h>

#include <cmath>
#include <memory>

namespace laboratory {
namespace {

using Residual = std::function<double(double, std::size_t)>;

constexpr std::size_t MAX_STEPS = 200;
constexpr double TOLERANCE = 1e-10;

int eval_residuals(const gsl_vector* parameter, void* data, gsl_vector* out) {
  const auto& residual = *static_cast<const Residual*>(data);
  for (std::size_t i = 0; i < out->size; ++i) {
    const double value = residual(gsl_vector_get(parameter, 0), i);
    if (!std::isfinite(value)) return GSL_EDOM;
    gsl_vector_set(out, i, value);
  }
  return GSL_SUCCESS;
}

// By default the library ends the program at an error.
struct QuietErrors {
  gsl_error_handler_t* before = gsl_set_error_handler_off();
  ~QuietErrors() { gsl_set_error_handler(before); }
};

}  // namespace

std::optional<FittedParameter> fit_curve(std::size_t points, double start,
                                         const Residual& residual) {
  const QuietErrors quiet;
  Residual copy = residual;
  gsl_multifit_nlinear_fdf problem{};
  problem.f = eval_residuals;
  problem.n = points;
  problem.p = 1;
  problem.params = &copy;
  const auto parameters = gsl_multifit_nlinear_default_parameters();
  const std::unique_ptr<gsl_multifit_nlinear_workspace, void (*)(gsl_multifit_nlinear_workspace*)>
      work(gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &parameters, points, 1),
           gsl_multifit_nlinear_free);
  const std::unique_ptr<gsl_matrix, void (*)(gsl_matrix*)> covariance(gsl_matrix_alloc(1, 1),
                                                                      gsl_matrix_free);
  gsl_vector_view at = gsl_vector_view_array(&start, 1);
  int info = 0;
  if (gsl_multifit_nlinear_init(&at.vector, &problem, work.get()) != GSL_SUCCESS) return {};
  const int status = gsl_multifit_nlinear_driver(MAX_STEPS, TOLERANCE, TOLERANCE, 0, nullptr,
                                                 nullptr, &info, work.get());
  // No progress: the start, or a step on the way, was as good as it gets.
  if (status != GSL_SUCCESS && status != GSL_ENOPROG) return {};
  FittedParameter found{gsl_vector_get(gsl_multifit_nlinear_position(work.get()), 0), 0, 0};
  gsl_multifit_nlinear_covar(gsl_multifit_nlinear_jac(work.get()), 0, covariance.get());
  const gsl_vector* residuals = gsl_multifit_nlinear_residual(work.get());
  gsl_blas_ddot(residuals, residuals, &found.squares);
  found.variance =
      gsl_matrix_get(covariance.get(), 0, 0) * found.squares / static_cast<double>(points - 1);
  if (!std::isfinite(found.value) || !std::isfinite(found.variance)) return {};
  return found;
}

}  // namespace laboratory

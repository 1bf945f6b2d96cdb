#include "experiments/laboratory/table/laws.hpp"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_fit.h>
#include <gsl/gsl_multifit_nlinear.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include "base/errors.hpp"
#include "experiments/laboratory/table/statistics.hpp"

namespace laboratory {
namespace {

struct Points {
  std::vector<double> n, speedup, growth;
};

bool is_good(double value) { return std::isfinite(value) && value > 0; }

// Chooses the points with a processor to share the work with: n = 1 fits any serial fraction.
Points choose_points(const std::vector<double>& n, const std::vector<double>& speedup,
                     const std::vector<double>& growth) {
  base::check_equal("points of a fit", speedup.size(), n.size());
  base::check_equal("growths of a fit", growth.size(), n.size());
  Points chosen;
  for (std::size_t i = 0; i < n.size(); ++i) {
    if (!is_good(n[i]) || !is_good(speedup[i]) || !is_good(growth[i]) || n[i] <= 1) continue;
    chosen.n.push_back(n[i]);
    chosen.speedup.push_back(speedup[i]);
    chosen.growth.push_back(growth[i]);
  }
  return chosen;
}

Estimate make_estimate(const std::string& name, double value, double variance, std::size_t free) {
  const double error = std::sqrt(std::max(0.0, variance));
  const double t = student_t(0.975, static_cast<double>(free));
  return {name, value, error, value - t * error, value + t * error};
}

double root_mean(double sum, std::size_t points) {
  return std::sqrt(std::max(0.0, sum) / static_cast<double>(points));
}

Fit make_share_fit(const std::string& law, const std::string& minimised, std::size_t points,
                   double serial, double variance, double squares) {
  return {law,
          {make_estimate("serial fraction", serial, variance, points - 1)},
          minimised,
          root_mean(squares, points),
          points};
}

// Fits the serial fraction s of y(n, S) = s (1 - 1/n).
std::optional<Fit> fit_share(const std::string& law, const std::string& minimised,
                             const std::vector<double>& n, const std::vector<double>& speedup,
                             double (*y)(double n, double speedup)) {
  const auto points = choose_points(n, speedup, std::vector<double>(n.size(), 1));
  const auto count = points.n.size();
  if (count < 2) return std::nullopt;
  std::vector<double> shared, measured;
  for (std::size_t i = 0; i < count; ++i) {
    shared.push_back(1 - 1 / points.n[i]);
    measured.push_back(y(points.n[i], points.speedup[i]));
  }
  double serial = 0, variance = 0, squares = 0;
  gsl_fit_mul(shared.data(), 1, measured.data(), 1, count, &serial, &variance, &squares);
  return make_share_fit(law, minimised, count, serial, variance, squares);
}

using Residual = std::function<double(double parameter, std::size_t i)>;

struct FittedParameter {
  double value = 0, variance = 0;
  double squares = 0;  // sum of the squared residuals
};

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

// While it lives, the library does not end the program at an error, as it does by default.
struct QuietErrors {
  gsl_error_handler_t* before = gsl_set_error_handler_off();
  ~QuietErrors() { gsl_set_error_handler(before); }
};

// Finds the parameter at which the sum of the squares of `residual(parameter, i)`, i from 0 to
// points - 1, is least, iterated from `start`; at least two points. The variance is that of the
// residuals, over points - 1, carried through the slope there. None where the iteration does not
// settle.
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
  // Without progress the start, or a step on the way, was as good as it gets.
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

}  // namespace

double amdahl_speedup(double serial, double n) { return 1 / (serial + (1 - serial) / n); }

double gustafson_speedup(double serial, double n) { return n + (1 - n) * serial; }

double sun_ni_speedup(double serial, double n, double growth) {
  const double parallel = (1 - serial) * growth;
  return (serial + parallel) / (serial + parallel / n);
}

std::optional<double> karp_flatt(double n, double speedup) {
  if (!is_good(n) || !is_good(speedup) || n <= 1) return std::nullopt;
  return (1 / speedup - 1 / n) / (1 - 1 / n);
}

std::optional<double> serial_gustafson(double n, double speedup) {
  if (!is_good(n) || !is_good(speedup) || n <= 1) return std::nullopt;
  return (n - speedup) / (n - 1);
}

std::optional<Fit> fit_amdahl(const std::vector<double>& n, const std::vector<double>& speedup) {
  return fit_share("Amdahl", "time / time on one", n, speedup,
                   [](double p, double s) { return 1 / s - 1 / p; });
}

std::optional<Fit> fit_gustafson(const std::vector<double>& n, const std::vector<double>& speedup) {
  return fit_share("Gustafson", "efficiency", n, speedup,
                   [](double p, double s) { return 1 - s / p; });
}

std::optional<Fit> fit_sun_ni(const std::vector<double>& n, const std::vector<double>& speedup,
                              const std::vector<double>& growth) {
  const auto points = choose_points(n, speedup, growth);
  if (points.n.size() < 2) return std::nullopt;
  double start = 0;
  for (std::size_t i = 0; i < points.n.size(); ++i)
    start += *serial_gustafson(points.n[i], points.speedup[i]) / double(points.n.size());
  const auto found =
      fit_curve(points.n.size(), std::clamp(start, 0.01, 0.9), [&](double serial, std::size_t i) {
        return (sun_ni_speedup(serial, points.n[i], points.growth[i]) - points.speedup[i]) /
               points.n[i];
      });
  if (!found) return std::nullopt;
  return make_share_fit("Sun-Ni", "efficiency", points.n.size(), found->value, found->variance,
                        found->squares);
}

std::optional<Fit> fit_log(const std::vector<double>& x, const std::vector<double>& y) {
  base::check_equal("points of a fit", y.size(), x.size());
  std::vector<double> logarithms, values;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!is_good(x[i]) || !std::isfinite(y[i])) continue;
    logarithms.push_back(std::log10(x[i]));
    values.push_back(y[i]);
  }
  const auto count = logarithms.size();
  if (count < 3 || std::ranges::max(logarithms) == std::ranges::min(logarithms))
    return std::nullopt;
  double a = 0, k = 0, a_variance = 0, covariance = 0, k_variance = 0, squares = 0;
  gsl_fit_linear(logarithms.data(), 1, values.data(), 1, count, &a, &k, &a_variance, &covariance,
                 &k_variance, &squares);
  return Fit{
      "log",
      {make_estimate("a", a, a_variance, count - 2), make_estimate("k", k, k_variance, count - 2)},
      "y",
      root_mean(squares, count),
      count};
}

}  // namespace laboratory

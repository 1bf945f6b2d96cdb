#include "experiments/laboratory/table/laws.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/errors.hpp"
#include "experiments/laboratory/table/least_squares.hpp"
#include "experiments/laboratory/table/linear_fit.hpp"
#include "experiments/laboratory/table/statistics.hpp"

namespace laboratory {
namespace {

struct Points {
  std::vector<double> n, speedup, growth;
};

bool is_good(double value) { return std::isfinite(value) && value > 0; }

// Omits points with n = 1, where every serial fraction gives the speed-up 1, and points with
// invalid values.
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
  return {law,       {make_estimate("serial fraction", serial, variance, points - 1)},
          minimised, root_mean(squares, points),
          points,    {}};
}

// Tests whether the residuals of a fit depend on log n. `terms` are the terms of the law, one list
// for each fitted parameter; `deviation` is the largest relative deviation of the law from the
// points.
std::optional<Misfit> find_misfit(std::vector<std::vector<double>> terms,
                                  const std::vector<double>& residuals,
                                  const std::vector<double>& n, double deviation) {
  constexpr double LEVEL = 0.975, LEAST_DEVIATION = 0.05;
  const auto used = terms.size() + 1;
  if (residuals.size() <= used || deviation <= LEAST_DEVIATION) return std::nullopt;
  std::vector<double> trend;
  for (const double x : n) trend.push_back(std::log(x));
  // If the law itself has the term log n (fit_log), tests for the square of log n instead.
  if (used > 2)
    for (double& value : trend) value *= value;
  terms.push_back(trend);
  const auto fit = fit_linear(std::move(terms), residuals);
  const double error = std::sqrt(std::max(0.0, fit.variance(used - 1)));
  const double t = error > 0 ? fit.factors[used - 1] / error : INFINITY;
  const double limit = student_t(LEVEL, static_cast<double>(residuals.size() - used));
  if (fit.factors[used - 1] == 0 || std::abs(t) <= limit) return std::nullopt;
  return Misfit{t, limit, deviation};
}

// The largest relative deviation of a law from the measured values.
template <class Law>
double find_deviation_of(const std::vector<double>& measured, Law law) {
  double most = 0;
  for (std::size_t i = 0; i < measured.size(); ++i)
    if (measured[i] != 0)
      most = std::max(most, std::abs(law(i) - measured[i]) / std::abs(measured[i]));
  return most;
}

// Fits the serial fraction s in the equation y(n, S) = s (1 - 1/n), where S is the speed-up.
std::optional<Fit> fit_share(const std::string& law, const std::string& minimised,
                             const std::vector<double>& n, const std::vector<double>& speedup,
                             double (*y)(double n, double speedup),
                             double (*eval)(double serial, double n)) {
  const auto points = choose_points(n, speedup, std::vector<double>(n.size(), 1));
  const auto count = points.n.size();
  if (count < 2) return std::nullopt;
  std::vector<double> shared, measured;
  for (std::size_t i = 0; i < count; ++i) {
    shared.push_back(1 - 1 / points.n[i]);
    measured.push_back(y(points.n[i], points.speedup[i]));
  }
  const auto fit = fit_linear({shared}, measured);
  auto made = make_share_fit(law, minimised, count, fit.factors[0], fit.variance(0), fit.squares);
  const double deviation = find_deviation_of(
      points.speedup, [&](std::size_t i) { return eval(fit.factors[0], points.n[i]); });
  made.misfit = find_misfit({shared}, fit.residuals, points.n, deviation);
  return made;
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
  return fit_share(
      "Amdahl", "time / time on one", n, speedup, [](double p, double s) { return 1 / s - 1 / p; },
      amdahl_speedup);
}

std::optional<Fit> fit_gustafson(const std::vector<double>& n, const std::vector<double>& speedup) {
  return fit_share(
      "Gustafson", "efficiency", n, speedup, [](double p, double s) { return 1 - s / p; },
      gustafson_speedup);
}

std::optional<Fit> fit_sun_ni(const std::vector<double>& n, const std::vector<double>& speedup,
                              const std::vector<double>& growth) {
  const auto points = choose_points(n, speedup, growth);
  if (points.n.size() < 2) return std::nullopt;
  double start = 0;
  for (std::size_t i = 0; i < points.n.size(); ++i)
    start += *serial_gustafson(points.n[i], points.speedup[i]) / double(points.n.size());
  const auto residuals = [&](const std::vector<double>& serial) {
    std::vector<double> values;
    for (std::size_t i = 0; i < points.n.size(); ++i)
      values.push_back(
          (sun_ni_speedup(serial[0], points.n[i], points.growth[i]) - points.speedup[i]) /
          points.n[i]);
    return values;
  };
  try {
    constexpr double STEP = 1e-5;
    const auto fit = fit_least_squares(residuals, {std::clamp(start, 0.01, 0.9)},
                                       [](std::size_t, double) { return STEP; });
    auto made = make_share_fit("Sun-Ni", "efficiency", points.n.size(), fit.parameters[0],
                               fit.errors[0] * fit.errors[0], fit.squares);
    const auto eval = [&](double serial, std::size_t i) {
      return sun_ni_speedup(serial, points.n[i], points.growth[i]);
    };
    std::vector<double> slopes;  // derivatives of the residuals with respect to the serial fraction
    for (std::size_t i = 0; i < points.n.size(); ++i)
      slopes.push_back((eval(fit.parameters[0] + STEP, i) - eval(fit.parameters[0] - STEP, i)) /
                       (2 * STEP * points.n[i]));
    made.misfit = find_misfit(
        {slopes}, fit.residuals, points.n,
        find_deviation_of(points.speedup, [&](auto i) { return eval(fit.parameters[0], i); }));
    return made;
  } catch (const std::runtime_error&) {  // the fit does not converge
    return std::nullopt;
  }
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
  const auto fit = fit_linear({std::vector<double>(count, 1), logarithms}, values);
  std::vector<double> powers;
  for (const double logarithm : logarithms) powers.push_back(std::pow(10, logarithm));
  const double deviation = find_deviation_of(
      values, [&](std::size_t i) { return fit.factors[0] + fit.factors[1] * logarithms[i]; });
  return Fit{
      "log",
      {make_estimate("a", fit.factors[0], fit.variance(0), count - 2),
       make_estimate("k", fit.factors[1], fit.variance(1), count - 2)},
      "y",
      root_mean(fit.squares, count),
      count,
      find_misfit({std::vector<double>(count, 1), logarithms}, fit.residuals, powers, deviation)};
}

}  // namespace laboratory

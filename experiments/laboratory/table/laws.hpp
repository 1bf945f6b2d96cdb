#pragma once
// Laws of speed-up, and fits of their serial fraction to measured speed-ups. n is the number of
// processors, S the speed-up, and s the serial fraction.

#include <optional>
#include <string>
#include <vector>

namespace laboratory {

/// Amdahl's law for a fixed problem size: 1 / (s + (1 - s) / n) (thesis, Eq 2.2).
double amdahl_speedup(double serial, double n);
/// Gustafson's law for a problem that grows with the machine: n + (1 - n) s (thesis, Eq 2.3).
double gustafson_speedup(double serial, double n);
/// Sun and Ni's law (1993) for a problem bounded by memory: (s + (1 - s) G) / (s + (1 - s) G / n).
/// The parallel work grows by the factor G = G(n). G = 1 gives Amdahl's law, G = n Gustafson's.
double sun_ni_speedup(double serial, double n, double growth);

/// Karp and Flatt's serial fraction, (1/S - 1/n) / (1 - 1/n): Amdahl's law solved for s at one
/// point. No value for n = 1, and for values that are not finite and positive.
std::optional<double> karp_flatt(double n, double speedup);
/// Gustafson's law solved for the serial fraction at one point: (n - S) / (n - 1) (thesis, Eq
/// 4.29). No value for n = 1, and for values that are not finite and positive.
std::optional<double> serial_gustafson(double n, double speedup);

/// A fitted parameter of a law.
struct Estimate {
  std::string name;  ///< name of the parameter, "serial fraction"
  double value = 0;
  double standard_error = 0;  ///< standard error, from the variance of the residuals
  double low = 0, high = 0;   ///< 95 % confidence interval by Student's t
};

/// A trend in the residuals of a fit. A trend shows that the law does not describe the points.
struct Misfit {
  /// t statistic of a term added to the law: log n, or its square if the law has log n itself
  double t = 0;
  double limit = 0;      ///< 97.5 % quantile of Student's t distribution, which |t| exceeds
  double deviation = 0;  ///< largest relative deviation of the law from a point
};

/// A least-squares fit of a law to points. Its confidence intervals assume independent residuals of
/// equal variance, so they are valid only without a misfit.
struct Fit {
  std::string law;
  std::vector<Estimate> parameters;
  std::string minimised;  ///< name of the quantity whose squared residuals are minimised
  double rms = 0;         ///< root mean square of the residuals of the minimised quantity
  /// number of points that determine the parameters; laws of speed-up do not count points at n = 1
  std::size_t points = 0;
  /// Test of the residuals (Ramsey's RESET test with one term): a term is added to the law and
  /// fitted to the residuals. The result is a misfit if this term differs from 0 at the 5 % level,
  /// and the law also deviates from a point by more than 5 %. No value otherwise, or with too few
  /// points.
  std::optional<Misfit> misfit = {};
};

/// Fits Amdahl's serial fraction to the run times 1/S, where the time on one processor is 1.
/// Minimises residuals of times, because times are what is measured, and because the law is linear
/// in them: 1/S - 1/n = s (1 - 1/n). The vectors have equal length. Ignores points whose values are
/// not finite and positive. No value for fewer than two points with n > 1.
std::optional<Fit> fit_amdahl(const std::vector<double>& n, const std::vector<double>& speedup);

/// Fits Gustafson's serial fraction to the efficiencies S/n: 1 - S/n = s (1 - 1/n). Minimises
/// residuals of efficiencies, because their errors, unlike those of S, do not grow with n. No value
/// for fewer than two points with n > 1.
std::optional<Fit> fit_gustafson(const std::vector<double>& n, const std::vector<double>& speedup);

/// Fits Sun and Ni's serial fraction to the efficiencies; each point has its own growth G.
/// Iterates, because the law is not linear in s. No value for fewer than two points with n > 1, and
/// if the iteration does not converge.
std::optional<Fit> fit_sun_ni(const std::vector<double>& n, const std::vector<double>& speedup,
                              const std::vector<double>& growth);

/// Fits y = a + k log10(x) by least squares of y (thesis, Eq 4.30, where k is called k_t). No value
/// for fewer than three points, or if all x are equal.
std::optional<Fit> fit_log(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace laboratory

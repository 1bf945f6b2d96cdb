#pragma once
// Laws of speed-up, and fits of their serial fraction to measured speed-ups.

#include <optional>
#include <string>
#include <vector>

namespace laboratory {

/// Amdahl's law for a fixed problem size: 1 / (s + (1 - s) / n) (thesis, Eq 2.2).
double amdahl_speedup(double serial, double n);
/// Gustafson's law for a problem that grows with the machine: n + (1 - n) s (thesis, Eq 2.3).
double gustafson_speedup(double serial, double n);
/// Sun and Ni's law (1993) for a problem bounded by memory: (s + (1 - s) G) / (s + (1 - s) G / n).
/// The parallel work grows by the factor G = G(n). G = 1 is Amdahl's law, G = n Gustafson's.
double sun_ni_speedup(double serial, double n, double growth);

/// Karp and Flatt's serial fraction, (1/S - 1/n) / (1 - 1/n): Amdahl's law solved for s at one
/// point. None for n = 1, and for values that are not finite and positive.
std::optional<double> karp_flatt(double n, double speedup);
/// Gustafson's law solved for the serial fraction at one point: (n - S) / (n - 1) (thesis, Eq
/// 4.29). None for n = 1, and for values that are not finite and positive.
std::optional<double> serial_gustafson(double n, double speedup);

/// A fitted parameter.
struct Estimate {
  std::string name;  ///< name of the parameter, "serial fraction"
  double value = 0;
  double standard_error = 0;  ///< standard error, from the variance of the residuals
  double low = 0, high = 0;   ///< 95 % confidence interval by Student's t
};

/// A trend in the residuals of a fit: the law does not describe the points.
struct Misfit {
  double t = 0;          ///< t statistic of the term log n, added to the law
  double limit = 0;      ///< its 97.5 % quantile, which |t| exceeds
  double deviation = 0;  ///< largest deviation of the law from the points, relative to them
};

/// A least-squares fit of a curve to points. The intervals assume independent residuals of equal
/// variance, so they hold only without a misfit.
struct Fit {
  std::string law;
  std::vector<Estimate> parameters;
  std::string minimised;  ///< name of the quantity whose squared residuals are minimised
  double rms = 0;         ///< root mean square of the residuals of the minimised quantity
  /// number of points that determine the parameters, without those at n = 1
  std::size_t points = 0;
  /// Test of the residuals (Ramsey's RESET test with one term): the fit is repeated with the term
  /// log n. A misfit is a term that differs from 0 at the 5 % level, if the law also deviates from
  /// a point by more than 5 %. None for fewer than three points with n > 1.
  std::optional<Misfit> misfit = {};
};

/// Fits Amdahl's serial fraction to run times in units of the time on one processor, 1/S. The
/// residuals are those of times, because times are measured and the law is linear in them: 1/S -
/// 1/n = s (1 - 1/n). None for fewer than two points with n > 1. The vectors have equal length.
/// Points with values that are not finite and positive are ignored.
std::optional<Fit> fit_amdahl(const std::vector<double>& n, const std::vector<double>& speedup);

/// Fits Gustafson's serial fraction to efficiencies S/n: 1 - S/n = s (1 - 1/n). Efficiencies are
/// fitted because their errors, unlike those of S, do not grow with n. Returns nullopt for fewer
/// than two points with n > 1.
std::optional<Fit> fit_gustafson(const std::vector<double>& n, const std::vector<double>& speedup);

/// Fits Sun and Ni's serial fraction to efficiencies, with a growth G for each point. Iterates,
/// because the law solved for s would have the measured S on both sides. None for fewer than two
/// points with n > 1, and without convergence.
std::optional<Fit> fit_sun_ni(const std::vector<double>& n, const std::vector<double>& speedup,
                              const std::vector<double>& growth);

/// Fits y = a + k log10(x) by the residuals of y (thesis, Eq 4.30, where k is k_t). None for fewer
/// than three points, or if all x are equal.
std::optional<Fit> fit_log(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace laboratory

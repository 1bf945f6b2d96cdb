#pragma once
// The laws of speed-up, and fits of their serial fraction to measured speed-ups.

#include <optional>
#include <string>
#include <vector>

namespace laboratory {

/// 1 / (s + (1 - s) / n): fixed problem size (Amdahl; thesis, Eq 2.2).
double amdahl_speedup(double serial, double n);
/// n + (1 - n) s: problem size grows with the machine (Gustafson; thesis, Eq 2.3).
double gustafson_speedup(double serial, double n);
/// (s + (1 - s) G) / (s + (1 - s) G / n): the parallel work grows by the factor G = G(n), bounded
/// by memory (Sun and Ni 1993). G = 1 is Amdahl's law, G = n Gustafson's.
double sun_ni_speedup(double serial, double n, double growth);

/// (1/S - 1/n) / (1 - 1/n), Karp and Flatt's serial fraction: Amdahl's law solved for s at one
/// point. None for n = 1 and for values that are not finite and positive.
std::optional<double> karp_flatt(double n, double speedup);
/// (n - S) / (n - 1): Gustafson's law solved for s at one point (thesis, Eq 4.29). None as above.
std::optional<double> serial_gustafson(double n, double speedup);

/// One fitted number.
struct Estimate {
  std::string name;  ///< "serial fraction"
  double value = 0;
  double standard_error = 0;  ///< square root of its variance, estimated from the residuals
  double low = 0, high = 0;   ///< its 95 % confidence interval, by Student's t
};

/// A least-squares fit of a curve through points. The intervals assume independent residuals of
/// equal variance; if a law does not hold, they are too narrow, and `rms` is large.
struct Fit {
  std::string law;
  std::vector<Estimate> parameters;
  std::string minimised;   ///< the quantity whose squared residuals are minimised
  double rms = 0;          ///< root mean square of those residuals
  std::size_t points = 0;  ///< number of points that determine the parameters, so without n = 1
};

/// Fits Amdahl's serial fraction. It minimises residuals of the run time in units of the time on
/// one processor, 1/S: time is measured, and the law is linear in it, 1/S - 1/n = s (1 - 1/n). None
/// for fewer than two points with n > 1. The vectors have equal length; points with values that are
/// not finite and positive are ignored.
std::optional<Fit> fit_amdahl(const std::vector<double>& n, const std::vector<double>& speedup);

/// Fits Gustafson's serial fraction. It minimises residuals of the efficiency S/n, whose errors do
/// not grow with the machine as those of S do: 1 - S/n = s (1 - 1/n). None as above.
std::optional<Fit> fit_gustafson(const std::vector<double>& n, const std::vector<double>& speedup);

/// Fits Sun and Ni's serial fraction, with a growth G per point. It minimises residuals of the
/// efficiency by iteration, since the law solved for s would have the measured S on both sides.
/// None as above, and if the iteration does not converge.
std::optional<Fit> fit_sun_ni(const std::vector<double>& n, const std::vector<double>& speedup,
                              const std::vector<double>& growth);

/// Fits y = a + k log10(x) (thesis, Eq 4.30, where k is k_t) by residuals of y. None for fewer than
/// three points, or if all x are equal.
std::optional<Fit> fit_log(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace laboratory

#pragma once
// The laws of speed-up, and what measured speed-ups say of their one parameter, the serial part.

#include <optional>
#include <string>
#include <vector>

namespace laboratory {

/// 1 / (s + (1 - s) / n): the problem stays (Amdahl; thesis, Eq 2.2).
double amdahl_speedup(double serial, double n);
/// n + (1 - n) s: the problem grows with the machine (Gustafson; thesis, Eq 2.3).
double gustafson_speedup(double serial, double n);
/// (s + (1 - s) G) / (s + (1 - s) G / n), where the parallel work grows by the factor G = G(n), as
/// memory lets it (Sun and Ni 1993). G = 1 is Amdahl's law, G = n Gustafson's.
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
  double standard_error = 0;  ///< square root of its variance, which the residuals' spread gives
  double low = 0, high = 0;   ///< its 95 % confidence interval, by Student's t
};

/// A curve through points by least squares. The intervals take the residuals for independent and of
/// one spread; where a law does not hold they are too narrow, and `rms` says so.
struct Fit {
  std::string law;
  std::vector<Estimate> parameters;
  std::string minimised;   ///< the quantity of which the squared residuals are least
  double rms = 0;          ///< root of the mean of those squares
  std::size_t points = 0;  ///< number of points that bear on the parameters: not those with n = 1
};

/// Fits Amdahl's serial fraction. It minimises residuals of the run time in units of the time on
/// one processor, 1/S: time is what is measured, and the law is linear in it, 1/S - 1/n = s (1 -
/// 1/n). None for fewer than two points with n > 1. The vectors have one length; points with values
/// that are not finite and positive do not count.
std::optional<Fit> fit_amdahl(const std::vector<double>& n, const std::vector<double>& speedup);

/// Fits Gustafson's serial fraction. It minimises residuals of the efficiency S/n, since its errors
/// do not grow with the machine as those of S do: 1 - S/n = s (1 - 1/n). None as above.
std::optional<Fit> fit_gustafson(const std::vector<double>& n, const std::vector<double>& speedup);

/// Fits Sun and Ni's serial fraction, with a growth G per point. It minimises residuals of the
/// efficiency; solved for s the law would have the measured S on both sides, so this one is
/// iterated. None as above, and where the iteration does not settle.
std::optional<Fit> fit_sun_ni(const std::vector<double>& n, const std::vector<double>& speedup,
                              const std::vector<double>& growth);

/// Fits y = a + k log10(x) (thesis, Eq 4.30, where k is k_t) by residuals of y. None for fewer than
/// three points, or for one x only.
std::optional<Fit> fit_log(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace laboratory

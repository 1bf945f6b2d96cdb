#pragma once
// Power laws of curves, and points where their exponents change.

#include <optional>
#include <vector>

namespace laboratory {

/// A curve as a power law: y grows as x^before up to `bend`, and as x^after beyond. Without a bend
/// the two exponents are equal.
struct PowerLaw {
  double before = 0, after = 0;
  std::optional<double> bend = {};
};

/// Fits a straight line to log y over log x, and broken lines that bend at an inner point, by least
/// squares. Chooses the best broken line if two conditions hold: its sum of squares is at most a
/// quarter of the straight line's, and its exponents differ by at least 0.2. None for fewer than
/// five points, for points that are not finite and positive, and for x that do not ascend.
std::optional<PowerLaw> fit_power_law(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace laboratory

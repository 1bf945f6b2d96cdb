#pragma once
// Fits power laws to curves, and finds the points where their exponents change.

#include <optional>
#include <vector>

namespace laboratory {

/// A curve as a power law: y grows as x^before up to x = bend, and as x^after beyond it. Without a
/// bend, both exponents are equal.
struct PowerLaw {
  double before = 0, after = 0;
  std::optional<double> bend = {};
};

/// Fits a straight line to log y over log x, and lines with a bend at each inner point, by least
/// squares. Chooses the best line with a bend if its sum of squares is at most a quarter of the
/// straight line's, and its two exponents differ by at least 0.2. No value for fewer than five
/// points, for points that are not finite and positive, and for x that do not ascend.
std::optional<PowerLaw> fit_power_law(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace laboratory

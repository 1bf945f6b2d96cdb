#pragma once
// Form factors in closed form: from J. Howell, "A Catalog of Radiation Heat Transfer Configuration
// Factors" (B: from a point with a normal; C: mean over a surface), and J. Lambert's of 1760.

#include <numbers>
#include <vector>

#include "renderer/scene/vec.hpp"

namespace radiosity::test::closed {

using renderer::Vec;
using std::atan;
using std::log;
using std::sqrt;
inline constexpr double PI = std::numbers::pi;

/// B-4: form factor from a point to a parallel rectangle with sides a and b at distance c. One
/// corner of the rectangle is on the point's normal.
inline double parallel_rectangle(double a, double b, double c) {
  const double x = a / c, y = b / c, u = sqrt(1 + x * x), v = sqrt(1 + y * y);
  return (x / u * atan(y / u) + y / v * atan(x / v)) / (2 * PI);
}

/// B-5: `height` along the point's normal, `width` across it, with its lower corner at distance c.
inline double upright_rectangle(double height, double width, double c) {
  const double x = height / width, y = c / width, r = sqrt(x * x + y * y);
  return (atan(1 / y) - y / r * atan(1 / r)) / (2 * PI);
}

/// B-12: a parallel disc with its centre on the normal.
inline double parallel_disc(double radius, double distance) {
  return radius * radius / (radius * radius + distance * distance);
}

/// C-11: from one rectangle a x b to an equal, parallel one at distance c.
inline double parallel_rectangles(double a, double b, double c) {
  const double x = a / c, y = b / c, u = sqrt(1 + x * x), v = sqrt(1 + y * y);
  return 2 / (PI * x * y) *
         (log(u * v / sqrt(1 + x * x + y * y)) + x * v * atan(x / v) + y * u * atan(y / u) -
          x * atan(x) - y * atan(y));
}

/// C-14: from a rectangle of width `width` to one of height `height`, at right angles, with a
/// common edge of `length`.
inline double upright_rectangles(double width, double height, double length) {
  const double w = width / length, h = height / length, ww = w * w, hh = h * h, s = ww + hh;
  const double logs = log((1 + ww) * (1 + hh) / (1 + s)) + ww * log(ww * (1 + s) / ((1 + ww) * s)) +
                      hh * log(hh * (1 + s) / ((1 + hh) * s));
  return (w * atan(1 / w) + h * atan(1 / h) - sqrt(s) * atan(1 / sqrt(s)) + logs / 4) / (PI * w);
}

/// C-41: coaxial discs, from the first to the second.
inline double coaxial_discs(double first, double second, double distance) {
  const double a = first / distance, b = second / distance, s = 1 + (1 + b * b) / (a * a);
  return (s - sqrt(s * s - 4 * (b / a) * (b / a))) / 2;
}

/// Lambert's formula for the part of a polygon above the point's horizon.
inline double polygon(const Vec& at, const Vec& normal, const std::vector<Vec>& corners) {
  std::vector<Vec> above;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec p = corners[i] - at, q = corners[(i + 1) % corners.size()] - at;
    const double hp = dot(normal, p), hq = dot(normal, q);
    if (hp >= 0) above.push_back(p);
    if ((hp < 0) != (hq < 0)) above.push_back(p + hp / (hp - hq) * (q - p));
  }
  double total = 0;
  for (std::size_t i = 0; i < above.size(); ++i) {
    const Vec &p = above[i], &q = above[(i + 1) % above.size()], side = cross(p, q);
    if (length(side) > 0)
      total += std::atan2(length(side), dot(p, q)) * dot(normal, side) / length(side);
  }
  return std::abs(total) / (2 * PI);
}

}  // namespace radiosity::test::closed

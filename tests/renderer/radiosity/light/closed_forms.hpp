#pragma once
// Form factors in closed form. They are from J. Howell, "A Catalog of Radiation Heat Transfer
// Configuration Factors", and from J. Lambert, 1760. In the catalog, numbers with B are for a point
// with a normal, numbers with C for the mean over a surface.

#include <numbers>
#include <vector>

#include "renderer/scene/vec.hpp"

namespace radiosity::test::closed {

using renderer::Vec;
using std::atan;
using std::log;
using std::sqrt;
inline constexpr double PI = std::numbers::pi;

/// Catalog B-4: from a point to a parallel rectangle with sides a and b at distance c. The point's
/// normal passes through one corner of the rectangle.
inline double parallel_rectangle(double a, double b, double c) {
  const double x = a / c, y = b / c, u = sqrt(1 + x * x), v = sqrt(1 + y * y);
  return (x / u * atan(y / u) + y / v * atan(x / v)) / (2 * PI);
}

/// Catalog B-5: from a point to a rectangle that extends by `height` along the point's normal and
/// by `width` across it. The rectangle's lower corner is at distance c.
inline double upright_rectangle(double height, double width, double c) {
  const double x = height / width, y = c / width, r = sqrt(x * x + y * y);
  return (atan(1 / y) - y / r * atan(1 / r)) / (2 * PI);
}

/// Catalog B-12: from a point to a parallel disc. The point's normal passes through the disc's
/// centre.
inline double parallel_disc(double radius, double distance) {
  return radius * radius / (radius * radius + distance * distance);
}

/// Catalog C-11: from a rectangle with sides a and b to an equal, parallel one at distance c.
inline double parallel_rectangles(double a, double b, double c) {
  const double x = a / c, y = b / c, u = sqrt(1 + x * x), v = sqrt(1 + y * y);
  return 2 / (PI * x * y) *
         (log(u * v / sqrt(1 + x * x + y * y)) + x * v * atan(x / v) + y * u * atan(y / u) -
          x * atan(x) - y * atan(y));
}

/// Catalog C-14: from a rectangle of width `width` to a rectangle of height `height` at right
/// angles to it. Both have a common edge of `length`.
inline double upright_rectangles(double width, double height, double length) {
  const double w = width / length, h = height / length, ww = w * w, hh = h * h, s = ww + hh;
  const double logs = log((1 + ww) * (1 + hh) / (1 + s)) + ww * log(ww * (1 + s) / ((1 + ww) * s)) +
                      hh * log(hh * (1 + s) / ((1 + hh) * s));
  return (w * atan(1 / w) + h * atan(1 / h) - sqrt(s) * atan(1 / sqrt(s)) + logs / 4) / (PI * w);
}

/// Catalog C-41: between coaxial discs, from the one with radius `first` to the one with radius
/// `second`.
inline double coaxial_discs(double first, double second, double distance) {
  const double a = first / distance, b = second / distance, s = 1 + (1 + b * b) / (a * a);
  return (s - sqrt(s * s - 4 * (b / a) * (b / a))) / 2;
}

/// Lambert's formula for the part of a polygon that is above the point's horizon.
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

#pragma once
// Points, directions and boxes in scene units (right-handed axes), and linear colours, where 1 is
// full intensity.

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace renderer {

struct Vec {
  double x = 0, y = 0, z = 0;
  bool operator==(const Vec&) const = default;
  /// Component x, y or z for `axis` 0, 1 or 2.
  double operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
};

inline Vec operator+(const Vec& a, const Vec& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec operator-(const Vec& a, const Vec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec operator-(const Vec& a) { return {-a.x, -a.y, -a.z}; }
inline Vec operator*(double s, const Vec& a) { return {s * a.x, s * a.y, s * a.z}; }
inline Vec operator*(const Vec& a, double s) { return s * a; }
inline Vec& operator+=(Vec& a, const Vec& b) { return a = a + b; }

inline double dot(const Vec& a, const Vec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec cross(const Vec& a, const Vec& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const Vec& a) { return std::sqrt(dot(a, a)); }
/// Unit vector in the direction of `a`, which must not be zero.
inline Vec normalize(const Vec& a) { return (1.0 / length(a)) * a; }
/// The largest absolute value of the components.
inline double max_abs(const Vec& a) {
  return std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)});
}

/// An axis-aligned box.
struct Bounds {
  static constexpr double INF = std::numeric_limits<double>::infinity();
  Vec lo{INF, INF, INF};  ///< initially an empty box
  Vec hi{-INF, -INF, -INF};
  bool operator==(const Bounds&) const = default;
};

inline Vec min(const Vec& a, const Vec& b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
inline Vec max(const Vec& a, const Vec& b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}
inline Bounds join(const Bounds& a, const Bounds& b) { return {min(a.lo, b.lo), max(a.hi, b.hi)}; }
inline Bounds join(const Bounds& a, const Vec& p) { return {min(a.lo, p), max(a.hi, p)}; }
inline Bounds make_bounds(std::span<const Vec> points) {
  Bounds bounds;
  for (const Vec& point : points) bounds = join(bounds, point);
  return bounds;
}
/// The box, enlarged by `margin` on every side.
inline Bounds grow(const Bounds& b, double margin) {
  const Vec by{margin, margin, margin};
  return {b.lo - by, b.hi + by};
}
/// True if `inner` lies in `outer`; their faces may touch.
inline bool contains(const Bounds& outer, const Bounds& inner) {
  return join(outer, inner) == outer;
}
/// Half the surface area of a box. It is proportional to the probability that a random ray meets
/// the box.
inline double half_area(const Bounds& b) {
  const Vec e = b.hi - b.lo;
  return e.x * e.y + e.y * e.z + e.z * e.x;
}

struct Rgb {
  double r = 0, g = 0, b = 0;
  bool operator==(const Rgb&) const = default;
};

inline Rgb operator+(const Rgb& a, const Rgb& b) { return {a.r + b.r, a.g + b.g, a.b + b.b}; }
inline Rgb operator-(const Rgb& a, const Rgb& b) { return {a.r - b.r, a.g - b.g, a.b - b.b}; }
inline Rgb operator*(const Rgb& a, const Rgb& b) { return {a.r * b.r, a.g * b.g, a.b * b.b}; }
inline Rgb operator*(double s, const Rgb& a) { return {s * a.r, s * a.g, s * a.b}; }
inline Rgb operator*(const Rgb& a, double s) { return s * a; }
inline Rgb& operator+=(Rgb& a, const Rgb& b) { return a = a + b; }
inline double max_component(const Rgb& a) { return std::max({a.r, a.g, a.b}); }

}  // namespace renderer

#pragma once
// Points and directions (right-handed, in scene units) and linear colour (1 = full intensity).

#include <algorithm>
#include <cmath>

namespace renderer {

struct Vec {
  double x = 0, y = 0, z = 0;
  bool operator==(const Vec&) const = default;
  /// Component 0, 1 or 2.
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
/// Unit vector along `a`, which must not be zero.
inline Vec normalize(const Vec& a) { return (1.0 / length(a)) * a; }
/// Largest absolute component.
inline double max_abs(const Vec& a) {
  return std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)});
}

struct Rgb {
  double r = 0, g = 0, b = 0;
  bool operator==(const Rgb&) const = default;
};

inline Rgb operator+(const Rgb& a, const Rgb& b) { return {a.r + b.r, a.g + b.g, a.b + b.b}; }
inline Rgb operator*(const Rgb& a, const Rgb& b) { return {a.r * b.r, a.g * b.g, a.b * b.b}; }
inline Rgb operator*(double s, const Rgb& a) { return {s * a.r, s * a.g, s * a.b}; }
inline Rgb operator*(const Rgb& a, double s) { return s * a; }
inline Rgb& operator+=(Rgb& a, const Rgb& b) { return a = a + b; }
inline double max_component(const Rgb& a) { return std::max({a.r, a.g, a.b}); }

}  // namespace renderer

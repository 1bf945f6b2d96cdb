#pragma once
// Axis-aligned boxes.

#include <limits>

#include "renderer/scene/vec.hpp"

namespace renderer {

struct Bounds {
  static constexpr double INF = std::numeric_limits<double>::infinity();
  Vec lo{INF, INF, INF};  ///< a new box is empty: it contains nothing
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
inline bool is_empty(const Bounds& b) { return !(b.lo.x <= b.hi.x); }
/// `b` grown by `margin` on every side.
inline Bounds grow(const Bounds& b, double margin) {
  const Vec by{margin, margin, margin};
  return {b.lo - by, b.hi + by};
}
/// Whether `inner` lies in `outer`, faces included.
inline bool contains(const Bounds& outer, const Bounds& inner) {
  return join(outer, inner) == outer;
}
/// Half the surface of a box, proportional to its chance of being met by a random ray.
inline double half_area(const Bounds& b) {
  const Vec e = b.hi - b.lo;
  return e.x * e.y + e.y * e.z + e.z * e.x;
}

}  // namespace renderer

#pragma once
// Convex polygons and segments, cut by planes.

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "renderer/scene/vec.hpp"

namespace radiosity {

using renderer::Vec;

struct Plane {
  Vec normal;  ///< unit
  double offset = 0;
};

/// The height of a point above the plane, > 0 on its normal's side.
inline double eval_height(const Plane& plane, const Vec& p) {
  return dot(plane.normal, p) - plane.offset;
}
/// The plane through a point, across a normal.
inline Plane make_plane(const Vec& normal, const Vec& point) {
  return {normal, dot(normal, point)};
}
inline Vec lerp(const Vec& a, const Vec& b, double t) { return a + t * (b - a); }
/// Distance of a point from the segment from a to b, which may have zero length.
double eval_distance(const Vec& point, const Vec& a, const Vec& b);
Vec eval_mean(std::span<const Vec> corners);
/// The mean with different rounding: each corner is divided before it is added.
Vec eval_centre(std::span<const Vec> corners);
/// The normal of the polygon's front, by Newell's method; its length is twice the area.
Vec eval_area_normal(std::span<const Vec> corners);

/// The part of a polygon that lies above the plane; corners within `tolerance` of the plane lie in
/// it. Empty unless a corner lies above.
std::vector<Vec> clip(std::span<const Vec> polygon, const Plane& plane, double tolerance);

/// The two points where the polygon's border crosses the plane; none if it does not.
std::optional<std::array<Vec, 2>> cut(std::span<const Vec> polygon, const Plane& plane);

/// A part of a segment, in fractions of its length.
struct Interval {
  double from = 0, to = 1;

  /// Cuts off the part with negative values of a linear function, `here` at 0 and `there` at 1.
  /// False if it is negative throughout.
  bool keep_positive(double here, double there);
};

/// Planes across the polygon through its edges, with its inside above them. Edges of zero length
/// have none.
std::vector<Plane> make_edge_planes(std::span<const Vec> polygon, const Vec& normal);

/// The part of the segment that is at least `margin` above all planes.
std::optional<Interval> clip_segment(const Vec& a, const Vec& b, std::span<const Plane> planes,
                                     double margin);

}  // namespace radiosity

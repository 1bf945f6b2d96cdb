#pragma once
// Planes, and their intersections with convex polygons and segments.

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "renderer/scene/triangulate.hpp"

namespace radiosity {

using renderer::Vec;

struct Plane {
  Vec normal;  ///< unit normal
  double offset = 0;
};

/// The height of a point above the plane; positive on the side of the normal.
inline double eval_height(const Plane& plane, const Vec& p) {
  return dot(plane.normal, p) - plane.offset;
}
/// The plane through `point` with the unit normal `normal`.
inline Plane make_plane(const Vec& normal, const Vec& point) {
  return {normal, dot(normal, point)};
}
inline Vec lerp(const Vec& a, const Vec& b, double t) { return a + t * (b - a); }
/// The distance of a point from the segment from a to b, which may have zero length.
double eval_distance(const Vec& point, const Vec& a, const Vec& b);
Vec eval_mean(std::span<const Vec> corners);
/// The mean of the corners. Unlike eval_mean(), this function divides each corner before adding it,
/// so that it rounds differently.
Vec eval_centre(std::span<const Vec> corners);
using renderer::eval_area_normal;

/// The part of a polygon above the plane. Corners within `tolerance` of the plane count as lying in
/// it. The result is empty if no corner lies above.
std::vector<Vec> clip(std::span<const Vec> polygon, const Plane& plane, double tolerance);

/// The two points where the polygon's border crosses the plane; none if they do not cross.
std::optional<std::array<Vec, 2>> cut(std::span<const Vec> polygon, const Plane& plane);

/// A part of a segment; positions are fractions of its length.
struct Interval {
  double from = 0, to = 1;

  /// Cuts off the part where a linear function is negative. The function has the value `here` at
  /// position 0 and `there` at position 1. Returns false if it is negative everywhere.
  bool keep_positive(double here, double there);
};

/// Planes through the edges of the polygon, perpendicular to it. The polygon is above them. Edges
/// of length zero are omitted.
std::vector<Plane> make_edge_planes(std::span<const Vec> polygon, const Vec& normal);

/// The part of the segment from a to b that is at least `margin` above all planes.
std::optional<Interval> clip_segment(const Vec& a, const Vec& b, std::span<const Plane> planes,
                                     double margin);

}  // namespace radiosity

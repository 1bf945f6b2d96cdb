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

/// Above the plane, on its normal's side, > 0.
inline double eval_height(const Plane& plane, const Vec& p) {
  return dot(plane.normal, p) - plane.offset;
}
inline Vec lerp(const Vec& a, const Vec& b, double t) { return a + t * (b - a); }
/// Of the corners.
Vec eval_mean(std::span<const Vec> corners);

/// What lies above the plane; corners within `tolerance` of it lie in it. Empty unless a corner
/// lies above.
std::vector<Vec> clip(std::span<const Vec> polygon, const Plane& plane, double tolerance);

/// Where the polygon's border passes from above the plane to below.
std::optional<std::array<Vec, 2>> cut(std::span<const Vec> polygon, const Plane& plane);

/// Of a way or a segment, its share from `from` to `to`.
struct Interval {
  double from = 0, to = 1;
};

/// The polygon's edges, as planes across it; above them is its inside. Edges of no length have
/// none.
std::vector<Plane> make_edge_planes(std::span<const Vec> polygon, const Vec& normal);

/// The part of the segment that is at least `margin` above all planes.
std::optional<Interval> clip_segment(const Vec& a, const Vec& b, std::span<const Plane> planes,
                                     double margin);

}  // namespace radiosity

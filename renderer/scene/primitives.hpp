#pragma once
// The four primitives of NFF, prepared for intersection. The make_ functions reject degenerate
// shapes with BadInput "found ..., expected ..."; readers of files add the place.

#include <cstdint>
#include <vector>

#include "renderer/scene/vec.hpp"

namespace renderer {

/// Object and surface of a primitive.
struct Tag {
  std::uint32_t object = 0;   ///< index in file order
  std::uint32_t surface = 0;  ///< index into Scene::surfaces
};

struct Sphere {
  Vec centre;
  double radius = 0;
  Tag tag;
};

/// A polygon's corner, projected along an axis onto the coordinate plane with the least distortion.
struct Corner {
  double u = 0, v = 0;
};

/// A flat polygon, convex or not; inside by the even-odd rule. On its front side its corners run
/// counter-clockwise.
struct Polygon {
  Vec normal;                          ///< unit, of the front
  double offset = 0;                   ///< plane: dot(normal, p) = offset
  std::uint32_t first = 0, count = 0;  ///< its corners in the scene's pool
  std::uint8_t u = 0, v = 1, w = 2;    ///< kept axes and dropped one
  Tag tag;
};

/// A polygon with normals interpolated between its corners. They point to its front side.
struct Patch : Polygon {
  std::uint32_t normals = 0;  ///< index of its first normal in the scene's pool of normals
};

/// A cone's or cylinder's side, open at both ends.
struct Cone {
  Vec base;
  Vec axis;  ///< unit, from base to apex
  double height = 0, base_radius = 0;
  double slope = 0;  ///< growth of the radius per unit of height
  Tag tag;
};

Sphere make_sphere(const Vec& centre, double radius, Tag tag);
/// Appends its corners to `pool`. Corners off the plane by more than 5 % of the polygon's size are
/// an error; others are moved into the plane along the dropped axis.
Polygon make_polygon(std::span<const Vec> corners, Tag tag, std::vector<Corner>& pool);
/// `corner_normals`: one for every corner, of any length but 0.
Patch make_patch(std::span<const Vec> corners, std::span<const Vec> corner_normals, Tag tag,
                 std::vector<Corner>& pool, std::vector<Vec>& normal_pool);
/// BadInput for corners that form no valid polygon, for instance without an area, or, with normals,
/// no valid patch.
void check_polygon(std::span<const Vec> corners, std::span<const Vec> corner_normals);
Cone make_cone(const Vec& base, double base_radius, const Vec& apex, double apex_radius, Tag tag);

/// Position of a polygon's corner: the dropped coordinate follows from the plane.
Vec eval_corner(const Polygon& polygon, const Corner& corner);

// Each moves a primitive; a polygon's corners are in `pool`.
void translate(Sphere& sphere, const Vec& by);
void translate(Polygon& polygon, const Vec& by, std::vector<Corner>& pool);
void translate(Cone& cone, const Vec& by);

Bounds make_bounds(const Sphere& sphere);
Bounds make_bounds(const Polygon& polygon, std::span<const Corner> pool);
Bounds make_bounds(const Cone& cone);

/// The unit normal of the primitive itself at a point on it.
inline Vec eval_normal(const Sphere& s, const Vec& point) { return normalize(point - s.centre); }
inline Vec eval_normal(const Polygon& p, const Vec&) { return p.normal; }
Vec eval_normal(const Cone& c, const Vec& point);

/// Values at a polygon's corners, interpolated at a point by mean value coordinates (M. Floater,
/// 2003), which are barycentric in a triangle and defined for any polygon. `sum` is the
/// interpolated value times a factor: 1 at a corner, > 0 on an edge. Elsewhere it has any sign, < 0
/// from the back of the projection.
struct Blend {
  Vec sum;
  enum class On : std::uint8_t { inside, edge, corner } on = On::inside;
};
Blend interpolate(const Polygon& polygon, std::span<const Corner> pool, std::span<const Vec> values,
                  const Vec& point);

/// The normal at a point, interpolated between those of the corners.
Vec eval_smooth_normal(const Patch& patch, std::span<const Corner> pool,
                       std::span<const Vec> normal_pool, const Vec& point);

// Tests of a ray against a primitive. Each intersect() returns the least distance > epsilon at
// which they meet, or infinity. A polygon may return infinity beyond `reach`.
//
// Self-intersection: a ray may start on this very primitive. The root at the origin is then exactly
// 0 and left out, regardless of rounding: a flat primitive has no other root, a quadric has one.
// The scene's epsilon is for other primitives through the origin.
//
// All are inlined into every traversal: calls would slow a rendering by a tenth.

inline constexpr double NO_HIT = std::numeric_limits<double>::infinity();

/// A ray with the counts of its tests.
struct Probe {
  const Vec &origin, &direction;
  std::uint32_t from;                  ///< object at the ray's origin
  double epsilon;                      ///< the scene's
  double reach;                        ///< hits beyond it do not matter
  const Corner* corners;               ///< the scene's pool
  std::uint32_t roots = 0, edges = 0;  ///< spheres with a root, polygons ahead

  bool starts_on(const Tag& tag) const { return tag.object == from; }
};

[[gnu::always_inline]] inline double intersect(const Sphere& s, Probe& ray) {
  const Vec &origin = ray.origin, &direction = ray.direction;
  const double epsilon = ray.epsilon;
  const Vec to_centre = s.centre - origin;
  const double along = dot(to_centre, direction);
  if (ray.starts_on(s.tag)) return 2 * along > epsilon ? 2 * along : NO_HIT;
  // Uses the foot of the perpendicular to avoid cancellation, however far away the origin is.
  const Vec across = to_centre - along * direction;
  const double square = s.radius * s.radius - dot(across, across);
  if (!(square >= 0)) return NO_HIT;
  ++ray.roots;
  const double half = std::sqrt(square);
  if (along - half > epsilon) return along - half;
  return along + half > epsilon ? along + half : NO_HIT;
}

/// Even-odd rule. An edge is always taken from its lower to its upper end, so that neighbours agree
/// on a shared edge to the last bit.
[[gnu::always_inline]] inline bool is_inside(std::span<const Corner> corners, double u, double v) {
  bool inside = false;
  const Corner* last = &corners.back();
  for (const Corner& corner : corners) {
    if ((corner.v > v) != (last->v > v)) {
      const Corner &a = corner.v > v ? *last : corner, &b = corner.v > v ? corner : *last;
      if ((b.u - a.u) * (v - a.v) > (u - a.u) * (b.v - a.v)) inside = !inside;
    }
    last = &corner;
  }
  return inside;
}

// A single predictable branch rejects polygons: half the feelers go towards a room's wall, but
// nearly all end before it.
[[gnu::always_inline]] inline double intersect(const Polygon& p, Probe& ray) {
  if (ray.starts_on(p.tag)) return NO_HIT;
  const Vec &origin = ray.origin, &direction = ray.direction;
  const double distance =
      (p.offset - dot(p.normal, origin)) / dot(p.normal, direction);  // may be NaN
  const bool ahead = (distance > ray.epsilon) & (distance < NO_HIT);
  ray.edges += ahead;
  if (!(ahead & (distance <= ray.reach))) return NO_HIT;
  const double u = origin[p.u] + distance * direction[p.u];
  const double v = origin[p.v] + distance * direction[p.v];
  return is_inside({ray.corners + p.first, p.count}, u, v) ? distance : NO_HIT;
}

[[gnu::always_inline]] inline double intersect(const Cone& c, Probe& ray) {
  const Vec &origin = ray.origin, &direction = ray.direction;
  const bool own = ray.starts_on(c.tag);
  // Starts near the cone, so that the squared lengths below have the size of the cone.
  const double start = own ? 0 : dot(c.base + 0.5 * c.height * c.axis - origin, direction);
  const Vec p = origin + start * direction - c.base;
  const double p_along = dot(p, c.axis), d_along = dot(direction, c.axis);
  const Vec p_across = p - p_along * c.axis, d_across = direction - d_along * c.axis;
  // p + t d|^2 across the axis = radius^2 at that height: a t^2 + 2 b t + k = 0.
  const double radius = c.base_radius + c.slope * p_along, growth = c.slope * d_along;
  const double a = dot(d_across, d_across) - growth * growth;
  const double b = dot(p_across, d_across) - radius * growth;
  const double k = own ? 0 : dot(p_across, p_across) - radius * radius;
  const double square = b * b - a * k;
  if (!(square >= 0)) return NO_HIT;
  const double q = -(b + std::copysign(std::sqrt(square), b));

  double nearest = NO_HIT;
  for (const double root : {q / a, own ? 0 : k / q}) {
    const double height = p_along + root * d_along;
    if (height >= 0 && height <= c.height && start + root > ray.epsilon && start + root < nearest)
      nearest = start + root;
  }
  return nearest;
}

}  // namespace renderer

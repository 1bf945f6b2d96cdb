#pragma once
// The four primitives of NFF, prepared for intersection. The make_ functions throw BadInput "found
// ..., expected ..." for degenerate shapes; readers of files add the position.

#include <cstdint>
#include <vector>

#include "renderer/scene/vec.hpp"

namespace renderer {

/// Object and surface that a primitive belongs to.
struct Tag {
  std::uint32_t object = 0;   ///< number of the object, in file order
  std::uint32_t surface = 0;  ///< surface of the object in Scene::surfaces
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

/// A flat polygon, convex or not. The even-odd rule defines its inside. Its corners run
/// counter-clockwise as seen from its front.
struct Polygon {
  Vec normal;                          ///< unit normal of the front
  double offset = 0;                   ///< the plane is dot(normal, p) = offset
  std::uint32_t first = 0, count = 0;  ///< range of its corners in the scene's pool
  std::uint8_t u = 0, v = 1, w = 2;    ///< kept axes u and v, and projection axis w
  Tag tag;
};

/// A polygon with normals interpolated between its corners. They point to its front.
struct Patch : Polygon {
  std::uint32_t normals = 0;  ///< index of its first normal in the scene's pool of normals
};

/// The side of a cone or cylinder, open at both ends.
struct Cone {
  Vec base;
  Vec axis;  ///< unit vector from base to apex
  double height = 0, base_radius = 0;
  double slope = 0;  ///< growth of the radius per unit of height
  Tag tag;
};

Sphere make_sphere(const Vec& centre, double radius, Tag tag);
/// Makes a polygon and appends its corners to `pool`. Corners off the plane by more than 5 % of the
/// polygon's size are an error. Others are moved into the plane along the projection axis.
Polygon make_polygon(std::span<const Vec> corners, Tag tag, std::vector<Corner>& pool);
/// Makes a patch. `corner_normals` has one for every corner, of any length but 0.
Patch make_patch(std::span<const Vec> corners, std::span<const Vec> corner_normals, Tag tag,
                 std::vector<Corner>& pool, std::vector<Vec>& normal_pool);
/// Throws BadInput if the corners form no valid polygon or, with normals, no valid patch. Polygons
/// without an area are invalid.
void check_polygon(std::span<const Vec> corners, std::span<const Vec> corner_normals);
Cone make_cone(const Vec& base, double base_radius, const Vec& apex, double apex_radius, Tag tag);

/// Position of a polygon's corner. Its coordinate along the projection axis follows from the plane.
Vec eval_corner(const Polygon& polygon, const Corner& corner);

// Translation of a primitive. The corners of a polygon are in `pool`.
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

/// Interpolation at a point between values at a polygon's corners, by mean value coordinates (M.
/// Floater, 2003). These are defined for any polygon, and barycentric in a triangle. `sum` is the
/// interpolated value times a factor: 1 at a corner, > 0 on an edge. Elsewhere its sign depends on
/// the side of projection.
struct Blend {
  Vec sum;
  enum class On : std::uint8_t { inside, edge, corner } on = On::inside;
};
Blend interpolate(const Polygon& polygon, std::span<const Corner> pool, std::span<const Vec> values,
                  const Vec& point);

/// The normal at a point, interpolated between those of the corners.
Vec eval_smooth_normal(const Patch& patch, std::span<const Corner> pool,
                       std::span<const Vec> normal_pool, const Vec& point);

// Ray-primitive tests. Each intersect() returns the least distance > epsilon at which the ray meets
// the primitive, or infinity. For polygons it may also return infinity for a distance beyond
// `reach`.
//
// Self-intersection: a ray may start on the tested primitive itself. The root at the origin is then
// known and omitted, regardless of rounding. A flat primitive has no other root, a quadric has one.
// The scene's epsilon applies to other primitives through the origin.
//
// All tests are inlined into every traversal, since calls would slow a rendering by a tenth.

inline constexpr double NO_HIT = std::numeric_limits<double>::infinity();

/// A ray with the counts of its tests.
struct Probe {
  const Vec &origin, &direction;
  std::uint32_t from;     ///< object at the ray's origin
  double epsilon;         ///< epsilon of the scene
  double reach;           ///< distance beyond which hits do not matter
  const Corner* corners;  ///< corner pool of the scene
  /// number of sphere tests with a root, and of polygon tests with the plane ahead
  std::uint32_t roots = 0, edges = 0;

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

/// Even-odd rule. Edges are evaluated from their lower to their upper end, so that neighbours agree
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

// Rejects polygons by a single predictable branch. Half of the feelers go towards a wall of the
// room, but nearly all end before it.
[[gnu::always_inline]] inline double intersect(const Polygon& p, Probe& ray) {
  if (ray.starts_on(p.tag)) return NO_HIT;
  const Vec &origin = ray.origin, &direction = ray.direction;
  const double distance =
      (p.offset - dot(p.normal, origin)) / dot(p.normal, direction);  // the distance may be NaN
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
  // Starts near the cone, so that the squared lengths below are of the order of the cone's size.
  const double start = own ? 0 : dot(c.base + 0.5 * c.height * c.axis - origin, direction);
  const Vec p = origin + start * direction - c.base;
  const double p_along = dot(p, c.axis), d_along = dot(direction, c.axis);
  const Vec p_across = p - p_along * c.axis, d_across = direction - d_along * c.axis;
  // The squared distance from the axis equals the squared radius, |p + t d|^2 = r^2, at that
  // height: a t^2 + 2 b t + k = 0.
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

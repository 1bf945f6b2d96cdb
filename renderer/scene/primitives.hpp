#pragma once
// The four primitives of NFF, with data prepared for intersection tests. The make_ functions throw
// BadInput "found ..., expected ..." for degenerate shapes; readers of files add the position.

#include <cstdint>
#include <vector>

#include "renderer/scene/vec.hpp"

namespace renderer {

/// The object and the surface to which a primitive belongs.
struct Tag {
  std::uint32_t object = 0;   ///< number of the object, from 0 in the file's order
  std::uint32_t surface = 0;  ///< index of the surface in Scene::surfaces
};

struct Sphere {
  Vec centre;
  double radius = 0;
  Tag tag;
};

/// Two coordinates. For a point of a polygon, they are the coordinates of its projection onto a
/// coordinate plane: the one in which the polygon is distorted least.
struct Corner {
  double u = 0, v = 0;
};

/// Two coordinates as in Corner, and the third coordinate.
struct Corner3 : Corner {
  double w = 0;
};

/// A line in the plane (u, v): the points with normal_u u + normal_v v = offset.
struct Line {
  double normal_u = 0, normal_v = 0, offset = 0;
};

/// A corner of a polygon, and the edge from it to the next corner. The edge's normal points to the
/// inside of a convex polygon. The normal is 0 if both corners are at the same position.
struct PolygonCorner : Corner3 {
  Line edge;
};

/// Shape of a polygon. In a bent polygon, corners are off the mean plane by more than rounding
/// errors.
enum class Shape : std::uint8_t { convex, concave, bent };

/// A polygon, which need not be convex. The even-odd rule defines its inside. Its corners are
/// counter-clockwise as seen from its front, except for a Patch.
struct Polygon {
  Vec normal;                          ///< unit normal of the front
  double offset = 0;                   ///< the mean plane is dot(normal, point) = offset
  std::uint32_t first = 0, count = 0;  ///< first corner in Scene::corners, and number of corners
  /// Indices of the axes u and v that are kept, and of the projected axis w.
  std::uint8_t u = 0, v = 1, w = 2;
  Shape shape = Shape::concave;
  Tag tag;
  /// Part of the limit in eval_closeness(), in scene units; infinite for a bent shape
  double slack = 0;
};

/// A polygon with normals that are interpolated between its corners. They point to its front.
struct Patch : Polygon {
  std::uint32_t normals = 0;  ///< index of its first normal in Scene::normals
};

/// The curved side of a cone or cylinder, which is open at both ends.
struct Cone {
  Vec base;
  Vec axis;  ///< unit vector from base to apex
  double height = 0, base_radius = 0;
  double slope = 0;  ///< growth of the radius per unit of height, from base to apex
  Tag tag;
};

Sphere make_sphere(const Vec& centre, double radius, Tag tag);
/// Makes a polygon and appends its corners to `pool`. Throws BadInput if a corner is off the mean
/// plane by more than 5 % of the polygon's size. A polygon that is bent less is a surface through
/// its edges.
Polygon make_polygon(std::span<const Vec> corners, Tag tag, std::vector<PolygonCorner>& pool);
/// Makes a patch. `corner_normals` has one normal for each corner, of any length except 0.
Patch make_patch(std::span<const Vec> corners, std::span<const Vec> corner_normals, Tag tag,
                 std::vector<PolygonCorner>& pool, std::vector<Vec>& normal_pool);
/// Throws BadInput if the corners form no valid polygon or, with normals, no valid patch. A polygon
/// without an area is invalid.
void check_polygon(std::span<const Vec> corners, std::span<const Vec> corner_normals);
Cone make_cone(const Vec& base, double base_radius, const Vec& apex, double apex_radius, Tag tag);

/// Position of a polygon's corner in the scene, with its original coordinates.
Vec eval_corner(const Polygon& polygon, const Corner3& corner);

// Move a primitive by a vector. The corners of a polygon are in `pool`.
void translate(Sphere& sphere, const Vec& by);
void translate(Polygon& polygon, const Vec& by, std::vector<PolygonCorner>& pool);
void translate(Cone& cone, const Vec& by);

Bounds make_bounds(const Sphere& sphere);
Bounds make_bounds(const Polygon& polygon, std::span<const PolygonCorner> pool);
Bounds make_bounds(const Cone& cone);

/// The unit normal of a primitive at a point on it. For a patch, this is the normal of its plane.
inline Vec eval_normal(const Sphere& s, const Vec& point) { return normalize(point - s.centre); }
inline Vec eval_normal(const Polygon& p, const Vec&) { return p.normal; }
Vec eval_normal(const Cone& c, const Vec& point);

/// Interpolation at a point between values at a polygon's corners, by mean value coordinates (M.
/// Floater, 2003). They exist for any polygon, and are barycentric in a triangle. `sum` is the
/// interpolated value multiplied by a factor: 1 at a corner, positive on an edge. Elsewhere, the
/// factor's sign depends on the side from which the polygon is projected.
struct Blend {
  Vec sum;
  enum class On : std::uint8_t { inside, edge, corner } on = On::inside;
};
Blend interpolate(const Polygon& polygon, std::span<const PolygonCorner> pool,
                  std::span<const Vec> values, const Vec& point);

/// The unit normal at a point of a patch, interpolated between the normals at the corners.
Vec eval_smooth_normal(const Patch& patch, std::span<const PolygonCorner> pool,
                       std::span<const Vec> normal_pool, const Vec& point);

// Intersection tests of a ray with a primitive. Each intersect() returns the smallest distance
// greater than epsilon at which the ray meets the primitive, or infinity. For polygons, it may also
// return infinity for a distance beyond `reach`.
//
// Self-intersection: a ray may start on the tested primitive itself. The solution at the ray's
// origin is then known and omitted, regardless of rounding. A flat primitive has no other solution,
// and a curved one has one more. The epsilon is for other primitives that contain the origin.
//
// All tests except intersect_closely() are inlined into every traversal, because calls would slow
// down a rendering by a tenth.

inline constexpr double NO_HIT = std::numeric_limits<double>::infinity();

/// A ray during a search, with the counts of its tests.
struct Probe {
  const Vec &origin, &direction;
  std::uint32_t from;            ///< number of the object on which the ray starts
  double epsilon;                ///< smallest distance of a hit (see eval_epsilon())
  double reach;                  ///< hits beyond this distance do not matter
  const PolygonCorner* corners;  ///< the corners in Scene::corners
  double closeness;              ///< part of a limit (see eval_closeness())
  /// Number of sphere tests whose equation has a solution, and of polygon tests with the plane
  /// ahead.
  std::uint32_t roots = 0, edges = 0;
  bool is_close = false;  ///< intersect_closely() found the last hit

  bool starts_on(const Tag& tag) const { return tag.object == from; }
};

[[gnu::always_inline]] inline double intersect(const Sphere& s, Probe& ray) {
  const Vec &origin = ray.origin, &direction = ray.direction;
  const double epsilon = ray.epsilon;
  const Vec to_centre = s.centre - origin;
  const double along = dot(to_centre, direction);
  if (ray.starts_on(s.tag)) return 2 * along > epsilon ? 2 * along : NO_HIT;
  // The foot of the perpendicular from the centre to the ray avoids cancellation even if the origin
  // is far away.
  const Vec across = to_centre - along * direction;
  const double square = s.radius * s.radius - dot(across, across);
  if (!(square >= 0)) return NO_HIT;
  ++ray.roots;
  const double half = std::sqrt(square);
  if (along - half > epsilon) return along - half;
  return along + half > epsilon ? along + half : NO_HIT;
}

// Watertight meshes (S. Woop, C. Benthin and I. Wald, 2013). Rounding moves the point at which a
// ray meets a polygon's plane, so that a ray through the common edge of two faces could miss both.
// The test in the plane therefore decides only if the point is farther from all edges than rounding
// can move it. Otherwise, intersect_closely() decides.

/// How far a point is inside a convex polygon: the smallest distance from the lines of its edges.
/// The result is negative outside.
[[gnu::always_inline]] inline double find_depth_in_convex(std::span<const PolygonCorner> corners,
                                                          double u, double v) {
  const auto side = [&](std::size_t i) __attribute__((always_inline)) {
    const Line& edge = corners[i].edge;
    return edge.normal_u * u + edge.normal_v * v - edge.offset;
  };
  double least = std::min(std::min(side(0), side(1)), side(2));
  for (std::size_t i = 3; i < corners.size(); ++i) least = std::min(least, side(i));
  return least;
}

/// Like find_depth_in_convex(), but for any polygon, by the even-odd rule. The result has the right
/// sign, but may be nearer to 0 than the distance to the nearest edge.
[[gnu::always_inline]] inline double find_depth(std::span<const PolygonCorner> corners, double u,
                                                double v) {
  bool inside = false;
  double nearest = NO_HIT;
  const PolygonCorner* last = &corners.back();
  for (const PolygonCorner& corner : corners) {
    nearest = std::min(nearest, std::abs(corner.v - v));
    const bool rises = corner.v > v;
    if (rises != (last->v > v)) {
      const Line& edge = last->edge;
      const double side = edge.normal_u * u + edge.normal_v * v - edge.offset;
      inside ^= (side > 0) == rises;
      nearest = std::min(nearest, std::abs(side));
    }
    last = &corner;
  }
  return inside ? nearest : -nearest;
}

/// Smallest distance of a hit point from an edge, as a multiple of the epsilon of rays that start
/// at the hit point.
inline constexpr double EDGE_MARGIN = 16;

/// A ray meets a polygon edge-on if the cosine between the polygon's normal and the ray is at most
/// this.
inline constexpr double EDGE_ON = 1e-6;

/// Part of Polygon::slack, relative to the largest coordinate. It exceeds EDGE_MARGIN times the
/// epsilon of rays that start on the polygon.
inline constexpr double CLOSE = 32e-10;

/// The ray's part of a limit, in scene units. If a perpendicular ray meets the polygon's plane
/// nearer than this limit to an edge, intersect_closely() decides whether it meets the polygon. The
/// other part of the limit is Polygon::slack. The sum is well above the rounding error of the point
/// in the plane. `shift` is the displacement of a moving polygon.
[[gnu::always_inline]] inline double eval_closeness(double epsilon, const Vec& shift = {}) {
  return EDGE_MARGIN * epsilon + CLOSE * max_abs(shift);
}

/// The distance at which a ray meets a polygon, including its edges, or infinity. For two polygons
/// with a common edge, the decision on which side of the edge a ray passes is the same to the last
/// bit. Therefore, no ray passes between them, regardless of their shapes and the order of their
/// corners.
[[gnu::noinline, gnu::cold]] double intersect_closely(const Polygon& polygon,
                                                      const PolygonCorner* pool, const Vec& origin,
                                                      const Vec& direction, double epsilon);

/// Moves a point of a polygon inwards if it is close to an edge. Rays from the new point then meet
/// neighbouring faces at a distance greater than `epsilon`, unless the angle between the faces is
/// less than about 4 degrees.
Vec pull_inside(const Polygon& polygon, const PolygonCorner* pool, const Vec& point,
                double epsilon);

// In a room, half of all rays to lights go towards a given wall, but nearly all of these rays end
// before the wall. The branches below reject such polygons. The host's processor predicts these
// branches well.
[[gnu::always_inline]] inline double intersect(const Polygon& p, Probe& ray) {
  if (ray.starts_on(p.tag)) return NO_HIT;
  const Vec &origin = ray.origin, &direction = ray.direction;
  const double along = dot(p.normal, direction);
  // NaN or infinite if the ray is parallel to the plane.
  const double distance = (p.offset - dot(p.normal, origin)) / along;
  const bool ahead = (distance > ray.epsilon) & (distance < NO_HIT);
  ray.edges += ahead;
  const double cosine = std::abs(along);
  if (!(ahead & (distance <= ray.reach))) {
    if ((cosine > EDGE_ON) & (p.shape != Shape::bent)) [[likely]]
      return NO_HIT;
  } else if (p.shape != Shape::bent) [[likely]] {
    const double u = origin[p.u] + distance * direction[p.u];
    const double v = origin[p.v] + distance * direction[p.v];
    const std::span corners(ray.corners + p.first, p.count);
    const double depth = cosine * (p.shape == Shape::convex ? find_depth_in_convex(corners, u, v)
                                                            : find_depth(corners, u, v));
    const double limit = p.slack + ray.closeness;
    if (depth > limit) return distance;
    if (depth < -limit) return NO_HIT;
  }
  const double found = intersect_closely(p, ray.corners, origin, direction, ray.epsilon);
  ray.is_close = found < NO_HIT;
  return found;
}

[[gnu::always_inline]] inline double intersect(const Cone& c, Probe& ray) {
  const Vec &origin = ray.origin, &direction = ray.direction;
  const bool own = ray.starts_on(c.tag);
  // Starts near the cone, so that the squared lengths below are not much larger than the cone's
  // size.
  const double start = own ? 0 : dot(c.base + 0.5 * c.height * c.axis - origin, direction);
  const Vec p = origin + start * direction - c.base;
  const double p_along = dot(p, c.axis), d_along = dot(direction, c.axis);
  const Vec p_across = p - p_along * c.axis, d_across = direction - d_along * c.axis;
  // At the ray's point p + t d, the squared distance from the axis equals the squared radius at
  // that height: (p_across + t d_across)^2 = (radius + t growth)^2. This has the form a t^2 + 2 b t
  // + k = 0.
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

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

/// A pair of coordinates. For a point of a polygon, they are those of its projection onto the
/// coordinate plane with the least distortion.
struct Corner {
  double u = 0, v = 0;
};

/// A pair of coordinates with the third one.
struct Corner3 : Corner {
  double w = 0;
};

/// A line in the plane (u, v): the points with normal_u u + normal_v v = offset.
struct Line {
  double normal_u = 0, normal_v = 0, offset = 0;
};

/// A polygon's corner and the edge from there to the next corner. The edge's normal points to the
/// inside of a convex polygon, and is 0 if the corners are at the same place.
struct PolygonCorner : Corner3 {
  Line edge;
};

/// Shape of a polygon. If it is bent, corners are off the mean plane by more than rounding.
enum class Shape : std::uint8_t { convex, concave, bent };

/// A polygon, convex or not. The even-odd rule defines its inside. Its corners run
/// counter-clockwise as seen from its front, unless it is a patch.
struct Polygon {
  Vec normal;                          ///< unit normal of the front
  double offset = 0;                   ///< the mean plane is dot(normal, p) = offset
  std::uint32_t first = 0, count = 0;  ///< range of its corners in the scene's pool
  std::uint8_t u = 0, v = 1, w = 2;    ///< kept axes u and v, and projection axis w
  Shape shape = Shape::concave;
  Tag tag;
  double slack = 0;  ///< see eval_closeness(), scene units; infinite if the shape is bent
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
/// Makes a polygon and appends its corners to `pool`. Corners off the mean plane by more than 5 %
/// of the polygon's size are an error. A polygon bent by less is a surface through its edges.
Polygon make_polygon(std::span<const Vec> corners, Tag tag, std::vector<PolygonCorner>& pool);
/// Makes a patch. `corner_normals` has one for every corner, of any length but 0.
Patch make_patch(std::span<const Vec> corners, std::span<const Vec> corner_normals, Tag tag,
                 std::vector<PolygonCorner>& pool, std::vector<Vec>& normal_pool);
/// Throws BadInput if the corners form no valid polygon or, with normals, no valid patch. Polygons
/// without an area are invalid.
void check_polygon(std::span<const Vec> corners, std::span<const Vec> corner_normals);
Cone make_cone(const Vec& base, double base_radius, const Vec& apex, double apex_radius, Tag tag);

/// Position of a polygon's corner, as given.
Vec eval_corner(const Polygon& polygon, const Corner3& corner);

// Translation of a primitive. The corners of a polygon are in `pool`.
void translate(Sphere& sphere, const Vec& by);
void translate(Polygon& polygon, const Vec& by, std::vector<PolygonCorner>& pool);
void translate(Cone& cone, const Vec& by);

Bounds make_bounds(const Sphere& sphere);
Bounds make_bounds(const Polygon& polygon, std::span<const PolygonCorner> pool);
Bounds make_bounds(const Cone& cone);

/// The unit normal of the primitive itself at a point on it.
inline Vec eval_normal(const Sphere& s, const Vec& point) { return normalize(point - s.centre); }
inline Vec eval_normal(const Polygon& p, const Vec&) { return p.normal; }
Vec eval_normal(const Cone& c, const Vec& point);

/// Interpolation at a point between values at a polygon's corners, by mean value coordinates (M.
/// Floater, 2003). These are defined for any polygon, and barycentric in a triangle. `sum` is the
/// interpolated value times a factor. The factor is 1 at a corner and > 0 on an edge. Elsewhere its
/// sign depends on the side from which the polygon is projected.
struct Blend {
  Vec sum;
  enum class On : std::uint8_t { inside, edge, corner } on = On::inside;
};
Blend interpolate(const Polygon& polygon, std::span<const PolygonCorner> pool,
                  std::span<const Vec> values, const Vec& point);

/// The normal at a point, interpolated between those of the corners.
Vec eval_smooth_normal(const Patch& patch, std::span<const PolygonCorner> pool,
                       std::span<const Vec> normal_pool, const Vec& point);

// Ray-primitive tests. Each intersect() returns the least distance > epsilon at which the ray meets
// the primitive, or infinity. For polygons it may also return infinity for a distance beyond
// `reach`.
//
// Self-intersection: a ray may start on the tested primitive itself. The root at the origin is then
// known and omitted, regardless of rounding. A flat primitive has no other root, a quadric has one.
// The epsilon is for other primitives that contain the origin.
//
// All tests, except for intersect_closely(), are inlined into every traversal, since calls would
// slow a rendering by a tenth.

inline constexpr double NO_HIT = std::numeric_limits<double>::infinity();

/// A ray with the counts of its tests.
struct Probe {
  const Vec &origin, &direction;
  std::uint32_t from;            ///< object at the ray's origin
  double epsilon;                ///< see eval_epsilon()
  double reach;                  ///< distance beyond which hits do not matter
  const PolygonCorner* corners;  ///< corner pool of the scene
  double closeness;              ///< see eval_closeness()
  /// number of sphere tests with a root, and of polygon tests with the plane ahead
  std::uint32_t roots = 0, edges = 0;
  bool is_close = false;  ///< intersect_closely() has hit the polygon

  bool starts_on(const Tag& tag) const { return tag.object == from; }
};

[[gnu::always_inline]] inline double intersect(const Sphere& s, Probe& ray) {
  const Vec &origin = ray.origin, &direction = ray.direction;
  const double epsilon = ray.epsilon;
  const Vec to_centre = s.centre - origin;
  const double along = dot(to_centre, direction);
  if (ray.starts_on(s.tag)) return 2 * along > epsilon ? 2 * along : NO_HIT;
  // Uses the foot of the perpendicular from the centre to the ray, which avoids cancellation even
  // if the origin is far away.
  const Vec across = to_centre - along * direction;
  const double square = s.radius * s.radius - dot(across, across);
  if (!(square >= 0)) return NO_HIT;
  ++ray.roots;
  const double half = std::sqrt(square);
  if (along - half > epsilon) return along - half;
  return along + half > epsilon ? along + half : NO_HIT;
}

// Watertight meshes (S. Woop, C. Benthin and I. Wald, 2013). Rounding moves the point at which a
// ray meets a polygon's plane. A ray through the common edge of two faces could thus miss both. The
// test in the plane therefore decides only if the point is farther from all edges than rounding can
// move it. Otherwise intersect_closely() decides.

/// How far a point is inside a convex polygon: its least distance from the lines of the edges.
/// Outside, the result is negative.
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

/// Like find_depth_in_convex(), but for any polygon, by the even-odd rule. The result may be nearer
/// to 0 than the distance of the nearest edge, but it has the right sign.
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

/// Least distance of a hit point from an edge, relative to the epsilon of rays that start at the
/// hit point.
inline constexpr double EDGE_MARGIN = 16;

/// Largest cosine between a polygon's normal and a ray that counts as meeting the polygon edge-on.
inline constexpr double EDGE_ON = 1e-6;

/// Part of Polygon::slack, relative to the largest coordinate. It is more than EDGE_MARGIN times
/// the epsilon of rays that start on the polygon.
inline constexpr double CLOSE = 32e-10;

/// The ray's part of the distance from an edge, in scene units, below which intersect_closely()
/// decides whether a perpendicular ray meets the polygon. The other part is Polygon::slack. The sum
/// is well above the rounding error of the point at which the ray meets the plane. `shift` is the
/// displacement of the polygon by its motion.
[[gnu::always_inline]] inline double eval_closeness(double epsilon, const Vec& shift = {}) {
  return EDGE_MARGIN * epsilon + CLOSE * max_abs(shift);
}

/// Distance at which a ray meets a polygon, edges included, or infinity. For two polygons with a
/// common edge, it is decided in the same way, to the last bit, on which side of the edge a ray
/// passes. No ray therefore passes between them, whatever their shapes and the order of their
/// corners.
[[gnu::noinline, gnu::cold]] double intersect_closely(const Polygon& polygon,
                                                      const PolygonCorner* pool, const Vec& origin,
                                                      const Vec& direction, double epsilon);

/// Moves a point of a polygon inside if it is close to an edge. Rays from the new point meet
/// neighbouring faces at more than `epsilon`, unless the angle between the faces is less than some
/// 4 degrees.
Vec pull_inside(const Polygon& polygon, const PolygonCorner* pool, const Vec& point,
                double epsilon);

// Half of the feelers in a room go towards a given wall, but nearly all end before it. Predictable
// branches reject such polygons.
[[gnu::always_inline]] inline double intersect(const Polygon& p, Probe& ray) {
  if (ray.starts_on(p.tag)) return NO_HIT;
  const Vec &origin = ray.origin, &direction = ray.direction;
  const double along = dot(p.normal, direction);
  const double distance = (p.offset - dot(p.normal, origin)) / along;  // may be NaN
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

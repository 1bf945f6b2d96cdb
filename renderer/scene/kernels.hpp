#pragma once
// One ray against one primitive. Each intersect() returns the least distance greater than epsilon
// at which the ray meets the primitive, or infinity.
//
// Self-intersection: a ray may start on this very primitive. The root at the origin is then exactly
// 0 and left out, whatever rounding would make of it: a flat primitive has no other root, a quadric
// has one. The scene's epsilon is for other primitives through the origin.
//
// All are inlined into every walk: calls would make a rendering a tenth slower.

#include "renderer/scene/primitives.hpp"

namespace renderer {

inline constexpr double NO_HIT = std::numeric_limits<double>::infinity();

/// A ray, and what its tests count.
struct Probe {
  const Vec &origin, &direction;
  std::uint32_t from;                  ///< the object that the ray starts on
  double epsilon;                      ///< the scene's
  const Corner* corners;               ///< the scene's pool
  std::uint32_t roots = 0, edges = 0;  ///< spheres whose root was taken, polygons whose edges were

  bool starts_on(const Tag& tag) const { return tag.object == from; }
};

[[gnu::always_inline]] inline double intersect(const Sphere& s, Probe& ray) {
  const Vec &origin = ray.origin, &direction = ray.direction;
  const double epsilon = ray.epsilon;
  const Vec to_centre = s.centre - origin;
  const double along = dot(to_centre, direction);
  if (ray.starts_on(s.tag)) return 2 * along > epsilon ? 2 * along : NO_HIT;
  // From the foot of the perpendicular: no cancellation however far away the origin is.
  const Vec across = to_centre - along * direction;
  const double square = s.radius * s.radius - dot(across, across);
  if (!(square >= 0)) return NO_HIT;
  ++ray.roots;
  const double half = std::sqrt(square);
  if (along - half > epsilon) return along - half;
  return along + half > epsilon ? along + half : NO_HIT;
}

/// Even-odd rule. An edge is always taken from its lower to its upper end, so that neighbours that
/// share it agree to the last bit.
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

[[gnu::always_inline]] inline double intersect(const Polygon& p, Probe& ray) {
  if (ray.starts_on(p.tag)) return NO_HIT;
  const Vec &origin = ray.origin, &direction = ray.direction;
  const double distance = (p.offset - dot(p.normal, origin)) / dot(p.normal, direction);
  if (!(distance > ray.epsilon && distance < NO_HIT)) return NO_HIT;
  ++ray.edges;
  const double u = origin[p.u] + distance * direction[p.u];
  const double v = origin[p.v] + distance * direction[p.v];
  return is_inside({ray.corners + p.first, p.count}, u, v) ? distance : NO_HIT;
}

[[gnu::always_inline]] inline double intersect(const Cone& c, Probe& ray) {
  const Vec &origin = ray.origin, &direction = ray.direction;
  const bool own = ray.starts_on(c.tag);
  // Start near the cone: what is squared below is then of its own size.
  const double start = own ? 0 : dot(c.base + 0.5 * c.height * c.axis - origin, direction);
  const Vec p = origin + start * direction - c.base;
  const double p_along = dot(p, c.axis), d_along = dot(direction, c.axis);
  const Vec p_across = p - p_along * c.axis, d_across = direction - d_along * c.axis;
  // |p + t d|^2 across the axis = radius^2 at that height: a t^2 + 2 b t + k = 0.
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

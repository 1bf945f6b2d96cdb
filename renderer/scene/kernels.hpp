#pragma once
// One ray against one primitive. Each intersect_ returns the least distance greater than `epsilon`
// at which the ray meets the primitive, or infinity.
//
// Self-intersection: `own` says that the ray starts on this very primitive. The root at the origin
// is then exactly 0 and left out, whatever rounding would make of it: a flat primitive has no other
// root, a quadric has one. The scene's epsilon is for other primitives through the origin.

#include <span>

#include "renderer/scene/primitives.hpp"

namespace renderer {

inline constexpr double NO_HIT = std::numeric_limits<double>::infinity();

/// Adds to `roots` if it takes a root.
inline double intersect_sphere(const Sphere& s, const Vec& origin, const Vec& direction,
                               double epsilon, bool own, std::uint32_t& roots) {
  const Vec to_centre = s.centre - origin;
  const double along = dot(to_centre, direction);
  if (own) return 2 * along > epsilon ? 2 * along : NO_HIT;
  // From the foot of the perpendicular: no cancellation however far away the origin is.
  const Vec across = to_centre - along * direction;
  const double square = s.radius * s.radius - dot(across, across);
  if (!(square >= 0)) return NO_HIT;
  ++roots;
  const double half = std::sqrt(square);
  if (along - half > epsilon) return along - half;
  return along + half > epsilon ? along + half : NO_HIT;
}

/// Even-odd rule. An edge is always taken from its lower to its upper end, so that neighbours that
/// share it agree to the last bit.
inline bool is_inside(std::span<const Corner> corners, double u, double v) {
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

/// Adds to `edges` if it looks at the polygon's edges.
inline double intersect_polygon(const Polygon& p, const Corner* pool, const Vec& origin,
                                const Vec& direction, double epsilon, bool own,
                                std::uint32_t& edges) {
  if (own) return NO_HIT;
  const double distance = (p.offset - dot(p.normal, origin)) / dot(p.normal, direction);
  if (!(distance > epsilon && distance < NO_HIT)) return NO_HIT;
  ++edges;
  const double u = origin[p.u] + distance * direction[p.u];
  const double v = origin[p.v] + distance * direction[p.v];
  return is_inside({pool + p.first, p.count}, u, v) ? distance : NO_HIT;
}

inline double intersect_cone(const Cone& c, const Vec& origin, const Vec& direction, double epsilon,
                             bool own) {
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
    if (height >= 0 && height <= c.height && start + root > epsilon && start + root < nearest)
      nearest = start + root;
  }
  return nearest;
}

inline Vec eval_normal(const Sphere& s, const Vec& point) { return normalize(point - s.centre); }

inline Vec eval_normal(const Cone& c, const Vec& point) {
  const double along = dot(point - c.base, c.axis);
  const Vec across = point - c.base - along * c.axis;
  const double radius = length(across);
  if (radius == 0) return c.axis;
  return normalize((1 / radius) * across - c.slope * c.axis);
}

/// The normal at a point, interpolated between those of the corners by mean value coordinates
/// (M. Floater, 2003), which are barycentric in a triangle and defined for any polygon.
Vec eval_normal(const Patch& patch, const Corner* corners, const Vec* normals, const Vec& point);

}  // namespace renderer

#pragma once
// The four primitives of NFF, prepared for intersection. The make_ functions reject degenerate
// shapes with BadInput "found ..., expected ..."; a reader of files adds the place.

#include <cstdint>
#include <vector>

#include "renderer/scene/vec.hpp"

namespace renderer {

/// Which object a primitive is, and of what surface.
struct Tag {
  std::uint32_t object = 0;   ///< index in file order
  std::uint32_t surface = 0;  ///< index into Scene::surfaces
};

struct Sphere {
  Vec centre;
  double radius = 0;
  Tag tag;
};

/// A corner of a polygon, in the two coordinates that its plane projects to with least distortion.
struct Corner {
  double u = 0, v = 0;
};

/// A flat polygon, convex or not; inside by the even-odd rule. Its front is the side from which
/// its corners run counter-clockwise.
struct Polygon {
  Vec normal;                          ///< unit, of the front
  double offset = 0;                   ///< plane: dot(normal, p) = offset
  std::uint32_t first = 0, count = 0;  ///< its corners in the scene's pool
  std::uint8_t u = 0, v = 1, w = 2;    ///< kept axes and dropped one
  Tag tag;
};

/// A polygon whose normal is interpolated between those of its corners, on whose side its front is.
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
/// an error; those by less are moved into it, along the dropped axis.
Polygon make_polygon(std::span<const Vec> corners, Tag tag, std::vector<Corner>& pool);
/// `corner_normals`: one for every corner, of any length but 0.
Patch make_patch(std::span<const Vec> corners, std::span<const Vec> corner_normals, Tag tag,
                 std::vector<Corner>& pool, std::vector<Vec>& normal_pool);
Cone make_cone(const Vec& base, double base_radius, const Vec& apex, double apex_radius, Tag tag);

Bounds make_bounds(const Sphere& sphere);
Bounds make_bounds(const Polygon& polygon, std::span<const Corner> pool);
Bounds make_bounds(const Cone& cone);

/// The normal of the primitive itself at a point on it, unit.
inline Vec eval_normal(const Sphere& s, const Vec& point) { return normalize(point - s.centre); }
inline Vec eval_normal(const Polygon& p, const Vec&) { return p.normal; }
Vec eval_normal(const Cone& c, const Vec& point);

/// The normal at a point, interpolated between those of the corners by mean value coordinates
/// (M. Floater, 2003), which are barycentric in a triangle and defined for any polygon.
Vec eval_smooth_normal(const Patch& patch, std::span<const Corner> pool,
                       std::span<const Vec> normal_pool, const Vec& point);

}  // namespace renderer

#pragma once
// Triangulation of polygons that are not flat or not convex.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/scene/vec.hpp"

namespace renderer {

/// The normal of the polygon's front, by Newell's method. Its length is twice the polygon's area.
Vec eval_area_normal(std::span<const Vec> corners);

/// True if all corners are within 1e-6 of the polygon's size from its plane. This plane passes
/// through the mean of the corners and is perpendicular to the area normal.
bool is_flat(std::span<const Vec> corners);

/// Indices of the three corners of a triangle.
using Triangle = std::array<std::uint32_t, 3>;

/// Divides a polygon into triangles with its orientation, by ear clipping (G. Meisters, 1975) in
/// the projection along its area normal. A convex quadrilateral is first cut from its first corner
/// to its third. Some triangles may have the area 0. Throws BadInput if the polygon has no area, if
/// edges cross in the projection, or if it has more than 1000 corners and is not convex.
std::vector<Triangle> triangulate(std::span<const Vec> corners);

}  // namespace renderer

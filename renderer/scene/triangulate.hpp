#pragma once
// Triangulation of polygons that are not flat or not convex.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/scene/vec.hpp"

namespace renderer {

/// The normal of the polygon's front, by Newell's method. Its length is twice the area.
Vec eval_area_normal(std::span<const Vec> corners);

/// True if no corner is off the polygon's plane by more than 1e-6 of its size. The plane goes
/// through the mean of the corners, across their area normal.
bool is_flat(std::span<const Vec> corners);

/// Indices of a triangle's corners.
using Triangle = std::array<std::uint32_t, 3>;

/// Cuts a polygon into triangles with the same winding, by ear clipping (G. Meisters, 1975) in the
/// projection along its area normal. The first cut of a convex quadrilateral goes from its first
/// corner to its third. Some triangles may have area 0. Throws BadInput if the polygon has no area,
/// if edges cross in the projection, or if it has more than 1000 corners and is not convex.
std::vector<Triangle> triangulate(std::span<const Vec> corners);

}  // namespace renderer

#pragma once
// A landscape of triangles, for scenes of many objects that all differ.

#include "renderer/scene/scene.hpp"

namespace renderer {

inline constexpr int MAX_HILLS = 1'000'000;

/// "hills:N": exactly `n` triangles, a lake between hills before mountains with snow. All `n` show
/// the same fractal ground, the finer the more there are. The triangles hang together without
/// cracks, and grow with their distance from the view point, so that they look alike in size. Water
/// is flat and mirrors; on land, normals are interpolated, but on a few splinters. Two lights. z is
/// up. The coordinates are made of sums, products and roots of a fixed seed's numbers: every
/// machine gets the same bits. BadInput unless 2 <= n <= MAX_HILLS.
Scene make_hills(int n);

}  // namespace renderer

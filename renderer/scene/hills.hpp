#pragma once
// A landscape of triangles, for scenes with many objects that all differ.

#include "renderer/scene/scene.hpp"

namespace renderer {

inline constexpr int MAX_HILLS = 1'000'000;

/// "hills:N": exactly `n` triangles, with a lake between hills in front of snowy mountains. Every
/// `n` shows the same fractal ground, finer with more triangles. The mesh has no cracks, and
/// triangles grow with distance from the view point, so that they look alike in size. Water is flat
/// and mirrors; on land, normals are interpolated except on a few splinters. Two lights. z is up.
/// Coordinates are sums, products and roots of seeded random numbers: every machine gets the same
/// bits. BadInput unless 2 <= n <= MAX_HILLS.
Scene make_hills(int n);

}  // namespace renderer

#pragma once
// A landscape of triangles, for scenes with many different objects.

#include "renderer/scene/scene.hpp"

namespace renderer {

inline constexpr int MAX_HILLS = 1'000'000;

/// Makes "hills:N" with exactly `n` triangles: a lake between hills, with snowy mountains behind
/// and two lights. z points up. Every `n` shows the same fractal ground, in more detail if `n` is
/// larger. The mesh has no cracks. Triangles grow with distance from the view point, so that they
/// appear similar in size. Water is flat and reflects; on land, normals are interpolated, except on
/// a few very thin triangles. Coordinates are sums, products and roots of seeded random numbers, so
/// that all hosts get the same bits. Throws BadInput unless 2 <= n <= MAX_HILLS.
Scene make_hills(int n);

}  // namespace renderer

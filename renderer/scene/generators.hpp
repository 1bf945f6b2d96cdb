#pragma once
// Scenes made by a formula.

#include "renderer/scene/scene.hpp"

namespace renderer {

inline constexpr int MAX_SPHERES = 2'000'000;

/// "spheres:N": the first `n` spheres, breadth first, of E. Haines's sphereflake (SPD "balls"), on
/// a floor, which is object 0; three lights. BadInput unless 1 <= n <= MAX_SPHERES.
Scene make_spheres(int n);

}  // namespace renderer

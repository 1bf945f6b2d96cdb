#pragma once
// Shadow rays that are searched for together, one in each lane.

#include "renderer/scene/lanes.hpp"
#include "renderer/scene/scene.hpp"
#include "renderer/scene/work.hpp"

namespace renderer {

/// Each lane's feeler, as a Ray has it. Lanes that have none may hold anything.
struct ShadowRays {
  Vecs origin, direction;  ///< unit length
  Lanes reach;
  Mask from;     ///< Ray::from
  Mask cast;     ///< -1: the lane has a feeler; 0: it has none
  Mask blocked;  ///< what find_blocked() found: -1 or 0
};

/// Sets `blocked` where intersect() under Traversal::nearest would find a hit, and adds the same
/// work; 0 where none is cast. The scene must be of polygons at rest, which is not checked.
/// Thread-safe.
void find_blocked(const Scene& scene, ShadowRays& rays, Work& work);

}  // namespace renderer

#pragma once
// Shadow rays (feelers) that are traced together, one in each SIMD lane.

#include "renderer/scene/lanes.hpp"
#include "renderer/scene/scene.hpp"
#include "renderer/scene/work.hpp"

namespace renderer {

/// The shadow rays of all lanes, with the fields of Ray. In a lane without a ray, these fields are
/// arbitrary.
struct ShadowRays {
  Vecs origin, direction;  ///< directions are unit vectors
  Lanes reach;
  Mask from;     ///< object on which each ray starts, as Ray::from
  Mask cast;     ///< -1: the lane has a ray; 0: it has none
  Mask blocked;  ///< result of find_blocked(): -1 if the ray is blocked, otherwise 0
};

/// Sets `blocked` to -1 in lanes where intersect() with Traversal::nearest would find a hit, and to
/// 0 in all other lanes, including those without a ray. Counts the same work. The scene must
/// consist of polygons that do not move; this is not checked. Thread-safe.
void find_blocked(const Scene& scene, ShadowRays& rays, Work& work);

}  // namespace renderer

#pragma once
// Shadow rays that are traced together, one in each SIMD lane.

#include "renderer/scene/lanes.hpp"
#include "renderer/scene/scene.hpp"
#include "renderer/scene/work.hpp"

namespace renderer {

/// The feeler of each lane, with the fields of a Ray. In lanes without one, the fields are
/// arbitrary.
struct ShadowRays {
  Vecs origin, direction;  ///< directions are unit vectors
  Lanes reach;
  Mask from;     ///< object at each ray's origin, as Ray::from
  Mask cast;     ///< -1: the lane has a feeler; 0: it has none
  Mask blocked;  ///< result of find_blocked(): -1 if blocked, else 0
};

/// Sets `blocked` to -1 if intersect() under Traversal::nearest would find a hit, else to 0, also
/// in lanes without a feeler. Adds the same work. The scene must consist of polygons at rest, which
/// is not checked. Thread-safe.
void find_blocked(const Scene& scene, ShadowRays& rays, Work& work);

}  // namespace renderer

#pragma once
// The first object on a ray.

#include <optional>

#include "renderer/scene/ray.hpp"
#include "renderer/scene/scene.hpp"
#include "renderer/scene/work.hpp"

namespace renderer {

/// How the hierarchy is walked. The hit does not depend on it, only the work does.
enum class Traversal : std::uint8_t {
  exhaustive,  ///< as in the thesis: boxes in stored order, not clipped by the nearest hit so far;
               ///< the first intersection is searched for every ray, feelers included
  nearest,  ///< boxes clipped by the nearest hit so far and by the ray's reach; a feeler stops at
            ///< any hit
  linear    ///< every primitive, no boxes
};

/// The nearest hit closer than the ray's reach; where hits are at equal distance, the one on the
/// lowest object. For a shadow feeler under Traversal::nearest it is any hit that blocks it. The
/// ray must start within the scene's bounds or at its view point (rounding, see finish()); its
/// direction is a unit vector. It does not meet the place where it starts (object `ray.from`, and
/// all within the scene's epsilon): see kernels.hpp. Adds to `work`; no errors. Thread-safe.
std::optional<Hit> intersect(const Scene& scene, const Ray& ray, Traversal traversal, Work& work);

}  // namespace renderer

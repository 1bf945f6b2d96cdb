#pragma once
// The first object on a ray.

#include <optional>

#include "renderer/scene/ray.hpp"
#include "renderer/trace/access.hpp"

namespace renderer {

/// How the hierarchy is walked. The hit does not depend on it, only the work does.
enum class Traversal : std::uint8_t {
  exhaustive,  ///< the thesis's: boxes in stored order, not clipped by the nearest hit so far; the
               ///< first intersection is searched for every ray, feelers included
  nearest,  ///< boxes clipped by the nearest hit so far and by the ray's reach; a feeler stops at
            ///< any hit
  linear    ///< every primitive, no boxes
};

/// The nearest hit closer than the ray's reach; of hits at equal distance the one of the lowest
/// object. Of a shadow feeler under Traversal::nearest it is any hit that blocks it. The ray must
/// start within the scene's bounds or at its view point (rounding, see finish()); its direction is
/// a unit vector. Where it starts (on object `ray.from`, and within the scene's epsilon) it meets
/// nothing: see kernels.hpp. Adds to `work`; no errors. Thread-safe.
std::optional<Hit> intersect(const Scene& scene, const Ray& ray, Traversal traversal, Work& work);

/// The same hit and the same work; `access` is told of every part of the scene that is read.
std::optional<Hit> intersect(const Scene& scene, const Ray& ray, Traversal traversal, Work& work,
                             Access& access);

}  // namespace renderer

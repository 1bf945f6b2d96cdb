#pragma once
// Which parts of a scene a ray's search reads: for scenes that are not all at hand.

#include "renderer/trace/intersect.hpp"

namespace renderer {

/// Is told of a part of the scene before every test against it; when it returns, the part may be
/// read. `done` is all that the kernel has counted until then, without this test.
/// (A copy of the nearest object so far is kept: its normal is not read again.)
struct Access {
  virtual ~Access() = default;
  /// `index` in Hierarchy::boxes; never a leaf.
  virtual void box(std::uint32_t index, const Work& done) = 0;
  virtual void object(Place place, const Work& done) = 0;
};

/// The same hit and the same work as without `access`.
std::optional<Hit> intersect(const Scene& scene, const Ray& ray, Traversal traversal, Work& work,
                             Access& access);

}  // namespace renderer

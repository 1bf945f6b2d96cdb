#pragma once
// Which parts of a scene a ray's search reads: for scenes that are not all at hand.

#include "renderer/scene/scene.hpp"
#include "renderer/scene/work.hpp"

namespace renderer {

/// Told of a part of the scene before every test against it; when it returns, the part may be
/// read. `done` is all that the kernel has counted until then, this test not yet.
/// (Of the nearest object so far a copy is kept: its normal is not read again.)
struct Access {
  virtual ~Access() = default;
  virtual void box(std::uint32_t index, const Work& done) = 0;  ///< in Hierarchy::boxes; no leaf
  virtual void object(Place place, const Work& done) = 0;
};

}  // namespace renderer

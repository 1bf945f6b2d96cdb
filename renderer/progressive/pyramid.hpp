#pragma once
// The pyramid test (thesis, 4.2.2, figure 4.4). It finds objects that may be visible within a cell
// although the samples on the cell's border miss them.

#include <vector>

#include "renderer/trace/shade.hpp"

namespace renderer::progressive {

/// An infinite pyramid from the eye through a rectangle of the image plane. Two opposite corners
/// define the rectangle.
class Pyramid {
 public:
  Pyramid(const Scene& scene, const PlanePoint& upper_left, const PlanePoint& lower_right);
  /// True if a ray of the pyramid meets the box. May also be true for a box outside of the pyramid,
  /// near an edge.
  bool may_meet(const Bounds& box) const;

 private:
  Vec eye_;
  Vec inward_[5];  // inward normals of the four sides, and the view direction
  Bounds reach_;   // bounding box of the pyramid, with infinite ends where the pyramid has
  double tolerance_;
};

/// True if the bounds of an object that is not in `seen` may reach into the pyramid. `seen` has a
/// flag for each object. Adds the number of examined bounds to `boxes`.
bool holds_unseen(const Scene& scene, const Pyramid& pyramid, const std::vector<bool>& seen,
                  std::uint64_t& boxes);

}  // namespace renderer::progressive

#pragma once
// The pyramid test (thesis, 4.2.2, figure 4.4) finds objects that may be visible within a cell of
// the image although the samples on the cell's border miss them.

#include <vector>

#include "renderer/trace/shade.hpp"

namespace renderer::progressive {

/// An infinite pyramid from the eye through a rectangle of the image plane between two points.
class Pyramid {
 public:
  Pyramid(const Scene& scene, const PlanePoint& upper_left, const PlanePoint& lower_right);
  /// Conservative test: true if a ray in the pyramid or in its sides meets the box. It can also be
  /// true for a box outside, near the pyramid's edges.
  bool may_meet(const Bounds& box) const;

 private:
  Vec eye_;
  Vec inward_[5];  // inward normals of its sides, and ahead
  Bounds reach_;   // bounds of the pyramid: each axis ends at the eye or is infinite
  double tolerance_;
};

/// True if the bounds of an object outside `seen`, a flag for each object, may reach into the
/// pyramid. Adds the number of examined bounds to `boxes`.
bool holds_unseen(const Scene& scene, const Pyramid& pyramid, const std::vector<bool>& seen,
                  std::uint64_t& boxes);

}  // namespace renderer::progressive

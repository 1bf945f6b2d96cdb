#pragma once
// The pyramid test (thesis, 4.2.2, figure 4.4). It finds objects that may be visible inside a cell
// of the image although all samples on the cell's border miss them.

#include <vector>

#include "renderer/trace/shade.hpp"

namespace renderer::progressive {

/// An infinite pyramid from the eye through a rectangle of the image plane, given by two opposite
/// corners.
class Pyramid {
 public:
  Pyramid(const Scene& scene, const PlanePoint& upper_left, const PlanePoint& lower_right);
  /// True if a ray of the pyramid meets the box. Near an edge of the pyramid, it may also return
  /// true for a box outside.
  bool may_meet(const Bounds& box) const;

 private:
  Vec eye_;
  Vec inward_[5];  // normals of the four sides, pointing inwards, and the view direction
  Bounds reach_;   // bounding box of the pyramid; infinite in some directions
  double tolerance_;
};

/// True if the bounding box of an object that has not been seen may meet the pyramid. `seen` has a
/// flag for each object. Adds the number of examined boxes to `boxes`.
bool holds_unseen(const Scene& scene, const Pyramid& pyramid, const std::vector<bool>& seen,
                  std::uint64_t& boxes);

}  // namespace renderer::progressive

#pragma once
// The pyramid test (thesis, 4.2.2, figure 4.4): which objects may be seen through a cell of the
// image, though its samples, which lie on its border, miss them.

#include <vector>

#include "renderer/trace/shade.hpp"

namespace renderer::progressive {

/// What is seen between two points of the image plane: a pyramid without an end, from the eye.
class Pyramid {
 public:
  Pyramid(const Scene& scene, const PlanePoint& upper_left, const PlanePoint& lower_right);
  /// Whether a box may reach into the pyramid. It does if a ray within the pyramid, or in its
  /// sides, meets the box; near its edges a box is taken for inside that is not.
  bool may_meet(const Bounds& box) const;

 private:
  Vec eye_;
  Vec inward_[5];  // across its sides, and ahead
  Bounds reach_;   // of the pyramid: on each axis it ends at the eye, or nowhere
  double tolerance_;
};

/// Whether the bounds of an object that is not in `seen`, a flag for each object, may reach into
/// the pyramid. Adds to `boxes` the bounds that it looks at.
bool holds_unseen(const Scene& scene, const Pyramid& pyramid, const std::vector<bool>& seen,
                  std::uint64_t& boxes);

}  // namespace renderer::progressive

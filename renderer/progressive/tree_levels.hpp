#pragma once
// Stepwise deepening of a shading tree without storing its rays (thesis, 4.2.1). To find the
// children of the rays of earlier levels, each step traces these rays again. It does not trace
// their rays to lights (shadow feelers) again.

#include "renderer/trace/render.hpp"

namespace renderer::progressive {

/// Numbers of rays of one or more shading trees.
struct TreeRays {
  std::uint64_t repeated = 0;  ///< N_A of thesis Eq 4.1: rays traced again
  RayCounts fresh;             ///< N_T of thesis Eq 4.1: rays of new levels, with shadow feelers
  Work work;                   ///< work of both repeated and new rays

  TreeRays& operator+=(const TreeRays& other);
};

/// Traces the levels `from` + 1 to `to` of the shading tree of pixel (x, y). If `from` is 0, the
/// tree is new. Adds the contributions of the new levels to the pixel's sums, which then equal
/// those of render() with depth `to`. `stack` must be empty, and is empty again afterwards. Returns
/// the number of the object that the ray from the eye hits, or NO_OBJECT.
std::uint32_t deepen(const Scene& scene, const Params& params, int x, int y, int from, int to,
                     Samples& samples, TreeRays& rays, Children& stack);

}  // namespace renderer::progressive

#pragma once
// Stepwise deepening of a shading tree without storing rays (thesis, 4.2.1). Each step traces the
// rays of earlier levels again to find their children. It does not trace their shadow feelers
// again.

#include "renderer/trace/render.hpp"

namespace renderer::progressive {

/// Numbers of rays of one or more trees.
struct TreeRays {
  std::uint64_t repeated = 0;  ///< N_A of Eq 4.1: rays traced again
  RayCounts fresh;             ///< N_T: rays of new levels, including feelers
  Work work;                   ///< work of repeated and new rays

  TreeRays& operator+=(const TreeRays& other);
};

/// Traces levels `from` + 1 to `to` of the tree of pixel (x, y). With `from` 0 the tree is new.
/// Adds the new levels' contributions to the pixel's sums, which then equal those of render() with
/// depth `to`. `stack` is empty before and after. Returns the object that the primary ray hits, or
/// NO_OBJECT.
std::uint32_t deepen(const Scene& scene, const Params& params, int x, int y, int from, int to,
                     Samples& samples, TreeRays& rays, Children& stack);

}  // namespace renderer::progressive

#pragma once
// A shading tree that is deepened in steps without storing rays (thesis, 4.2.1). Each step traces
// the rays of earlier levels again to find their children, but not the shadow feelers.

#include "renderer/trace/render.hpp"

namespace renderer::progressive {

/// Rays of one or more trees.
struct TreeRays {
  std::uint64_t repeated = 0;  ///< N_A of Eq 4.1: traced again
  RayCounts fresh;             ///< N_T: new levels, with their feelers
  Work work;                   ///< of both

  TreeRays& operator+=(const TreeRays& other);
};

/// Traces the tree of pixel (x, y) from level `from` + 1 (`from` 0: a new tree) to level `to`. Adds
/// the contributions of the new levels to the pixel's sums, which then equal those of render() with
/// depth `to`. `stack` is empty before and after. Returns the primary ray's object, or NO_OBJECT.
std::uint32_t deepen(const Scene& scene, const Params& params, int x, int y, int from, int to,
                     Samples& samples, TreeRays& rays, Children& stack);

}  // namespace renderer::progressive

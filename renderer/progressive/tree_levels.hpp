#pragma once
// A shading tree that is made deeper in steps, without a store of rays (thesis, 4.2.1): the rays of
// the levels before are traced again, to find those that they leave, and shadow feelers are not.

#include "renderer/trace/render.hpp"

namespace renderer::progressive {

/// Rays of one or more trees.
struct TreeRays {
  std::uint64_t repeated = 0;  ///< N_A of Eq 4.1: traced again
  RayCounts fresh;             ///< N_T: of the new levels, with their feelers
  Work work;                   ///< of both

  TreeRays& operator+=(const TreeRays& other);
};

/// Traces the tree of pixel (x, y) from level `from` + 1, 0 for a new tree, to level `to`, and adds
/// what the new levels contribute to the pixel's sums: after it they are those of render() with
/// `to` as its depth. `stack` is empty before and after. Returns the object that the primary ray
/// hits, or NO_OBJECT.
std::uint32_t deepen(const Scene& scene, const Params& params, int x, int y, int from, int to,
                     Samples& samples, TreeRays& rays, Children& stack);

}  // namespace renderer::progressive

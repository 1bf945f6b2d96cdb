#pragma once
// Automatic bounding-volume hierarchy (J. Goldsmith and J. Salmon, "Automatic Creation of Object
// Hierarchies for Ray Tracing", IEEE CG&A 7(5), 1987). It inserts objects one by one in the given
// order, each where the expected number of tests per ray grows least.

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "renderer/scene/vec.hpp"

namespace renderer {

/// A bounding box of the hierarchy, or a leaf with one object.
struct alignas(64) Box {
  static constexpr std::uint32_t INNER = std::numeric_limits<std::uint32_t>::max();
  Bounds bounds;
  std::uint32_t skip = 0;      ///< index of the next box if the ray misses this one
  std::uint32_t item = INNER;  ///< object of a leaf; INNER for a box of boxes
};

/// Boxes depth first, children in the order of insertion, so that traversal needs no stack. If a
/// ray hits a box, the next one in the list is tested, and after a miss the one at `skip`.
struct Hierarchy {
  std::vector<Box> boxes;
  /// Displacement of each box's corners while the shutter is open; empty: no motion. Corners move
  /// linearly like the objects, so that a box always contains its objects (A. Glassner, "Spacetime
  /// Ray Tracing for Animation", 1988). `boxes` holds the bounds when the shutter opens.
  std::vector<Bounds> moves;
};

/// Makes the hierarchy of `objects`. The `item` of a leaf is the index of its object. There are no
/// boxes without objects. If insertion would take quadratic time, as for many objects in one place,
/// the last objects are split recursively at medians instead.
Hierarchy make_hierarchy(std::span<const Bounds> objects);
/// Makes the hierarchy of objects that move from their bounds when the shutter opens to those when
/// it closes. Builds hierarchies for both times and halfway, and returns the one of least expected
/// cost.
Hierarchy make_hierarchy(std::span<const Bounds> at_open, std::span<const Bounds> at_close);

}  // namespace renderer

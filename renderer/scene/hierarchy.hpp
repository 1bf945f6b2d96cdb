#pragma once
// Automatic bounding-volume hierarchy: J. Goldsmith and J. Salmon, "Automatic Creation of Object
// Hierarchies for Ray Tracing", IEEE CG&A 7(5), 1987. Inserts objects one by one, in the given
// order, each where the expected number of tests per ray grows least.

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "renderer/scene/vec.hpp"

namespace renderer {

/// One volume of the hierarchy, or a leaf: one object.
struct alignas(64) Box {
  static constexpr std::uint32_t INNER = std::numeric_limits<std::uint32_t>::max();
  Bounds bounds;
  std::uint32_t skip = 0;      ///< index of the next box if this one is missed
  std::uint32_t item = INNER;  ///< a leaf's object; INNER for a box of boxes
};

/// Boxes depth first, children in the order of insertion, so that traversal needs no stack. The
/// next box is the following one after a hit, and the one at `skip` after a miss.
struct Hierarchy {
  std::vector<Box> boxes;
  /// Displacement of each box's corners while the shutter is open, in a scene with motion. Corners
  /// move linearly like the objects, so that a box always contains its objects (A. Glassner,
  /// "Spacetime Ray Tracing for Animation", 1988). `boxes` holds the bounds when the shutter opens.
  /// Empty: no motion.
  std::vector<Bounds> moves;
};

/// A leaf's `item` is the object's index in `objects`. No objects, no boxes. If insertion would
/// take quadratic time, as for many objects in one place, the last ones are split recursively at
/// medians instead.
Hierarchy make_hierarchy(std::span<const Bounds> objects);
/// The same for objects that move between their bounds when the shutter opens and when it closes.
/// Builds hierarchies for both times and halfway, and returns the one of least expected cost.
Hierarchy make_hierarchy(std::span<const Bounds> at_open, std::span<const Bounds> at_close);

}  // namespace renderer

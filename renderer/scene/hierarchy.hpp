#pragma once
// Automatic bounding-volume hierarchy (J. Goldsmith and J. Salmon, "Automatic Creation of Object
// Hierarchies for Ray Tracing", IEEE CG&A 7(5), 1987). Objects are inserted one by one in the given
// order, each where the expected number of tests per ray grows least.

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "renderer/scene/vec.hpp"

namespace renderer {

/// A bounding box of the hierarchy. It contains further boxes, or is a leaf with one object.
struct alignas(64) Box {
  static constexpr std::uint32_t INNER = std::numeric_limits<std::uint32_t>::max();
  Bounds bounds;
  std::uint32_t skip = 0;      ///< index of the box to test next if the ray misses this one
  std::uint32_t item = INNER;  ///< for a leaf, its object; INNER for a box with further boxes
};

/// The boxes in depth-first order, so that traversal needs no stack. Children are in the order of
/// insertion. If a ray hits a box, the next box in the list is tested; if it misses, the box at
/// `skip`.
struct Hierarchy {
  std::vector<Box> boxes;
  /// Displacement of each box's corners while the shutter is open; empty if nothing moves. `boxes`
  /// has the positions when the shutter opens. Corners move linearly, as the objects do, so that a
  /// box always contains its objects (A. Glassner, "Spacetime Ray Tracing for Animation", 1988).
  std::vector<Bounds> moves;
};

/// Makes the hierarchy of objects with the given bounding boxes. `item` of a leaf is an index into
/// `objects`. No box is empty. If insertion would take quadratic time, as for many objects in one
/// place, the last objects are split recursively at medians instead.
Hierarchy make_hierarchy(std::span<const Bounds> objects);
/// Makes the hierarchy of moving objects. `at_open` has their bounding boxes when the shutter
/// opens, `at_close` when it closes. Builds hierarchies for both times and for halfway, and returns
/// the one with the lowest expected cost.
Hierarchy make_hierarchy(std::span<const Bounds> at_open, std::span<const Bounds> at_close);

}  // namespace renderer

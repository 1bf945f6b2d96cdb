#pragma once
// Automatic bounding-volume hierarchy: J. Goldsmith and J. Salmon, "Automatic Creation of Object
// Hierarchies for Ray Tracing", IEEE CG&A 7(5), 1987. Objects are inserted one by one, in the
// order given, each where the expected number of tests per ray grows least.

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
  std::uint32_t skip = 0;      ///< index of the next box when this one is missed
  std::uint32_t item = INNER;  ///< what a leaf holds; INNER for a box of boxes
};

/// Depth first, children in the order they were inserted: a walk needs no stack. After a box that
/// is met comes the one stored next, after one that is missed the one at its `skip`.
struct Hierarchy {
  std::vector<Box> boxes;
  /// In a scene where objects move: how far the corners of each box do while the shutter is open.
  /// They move evenly, as the objects do, so that a box holds what is in it all the time (A.
  /// Glassner, "Spacetime Ray Tracing for Animation", 1988). The boxes are where they are when it
  /// opens. Empty: nothing moves.
  std::vector<Bounds> moves;
};

/// A leaf's `item` is the object's index in `objects`. No objects, no boxes. Where insertion would
/// take a time that grows with the square of their number, as for many objects in one place, the
/// last ones are not inserted but halved by place again and again.
Hierarchy make_hierarchy(std::span<const Bounds> objects);
/// The same of objects that move, from where they are when the shutter opens to where they are when
/// it closes: of those made of where they are then and halfway, the one of least expected cost.
Hierarchy make_hierarchy(std::span<const Bounds> at_open, std::span<const Bounds> at_close);

}  // namespace renderer

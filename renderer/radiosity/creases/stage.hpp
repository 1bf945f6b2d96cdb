#pragma once
// Finds the creases that one light causes on one receiver. Creases are lines where the illumination
// or its derivatives jump.

#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// One side of a face that emits or receives light.
struct FaceSide {
  std::vector<Vec> corners;  ///< counter-clockwise
  Plane plane;               ///< plane of the face; this side is above the plane
};

/// A light, a receiver, and the faces that may be between them.
struct Stage {
  FaceSide light;  ///< part of the light above the receiver
  FaceSide receiver;
  std::vector<std::vector<Vec>> between;  ///< parts of other faces above light and receiver
  double tolerance = 0;                   ///< lengths below this value are rounding errors
};

/// Creases on a receiver.
struct StageCreases {
  std::vector<Crease> borders;  ///< borders of penumbrae and umbrae
  /// Lines within a penumbra, where one more corner of the light becomes visible.
  std::vector<Crease> within;
};

/// Finds where the receiver meets the plane of the light and the critical planes of the light and
/// each occluder. Omits parts that other faces hide. creases.hpp explains critical planes.
StageCreases find_creases(const Stage& stage);

}  // namespace radiosity

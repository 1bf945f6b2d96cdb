#pragma once
// Creases that one light causes on one receiver.

#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// A side of a face that emits or receives light.
struct FaceSide {
  std::vector<Vec> corners;  ///< corners, counter-clockwise
  Plane plane;               ///< plane of the face; the side is the one above
};

/// A light, a receiver and the faces between them.
struct Stage {
  FaceSide light;  ///< part of the light above the receiver
  FaceSide receiver;
  std::vector<std::vector<Vec>> between;  ///< parts of other faces above light and receiver
  double tolerance = 0;                   ///< length below which differences are rounding errors
};

/// Creases on a receiver.
struct StageCreases {
  std::vector<Crease> borders;  ///< borders of penumbrae and umbrae
  /// lines within a penumbra at which another corner of the light becomes visible
  std::vector<Crease> within;
};

/// Intersections of the receiver with the light's own plane, and with the critical planes of the
/// light and each occluder. Parts that other faces hide are excluded. See find_creases() for rooms.
StageCreases find_creases(const Stage& stage);

}  // namespace radiosity

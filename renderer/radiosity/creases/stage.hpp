#pragma once
// Creases of one light on one receiver.

#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// A side of a face that emits or receives light.
struct FaceSide {
  std::vector<Vec> corners;  ///< counter-clockwise
  Plane plane;               ///< the side is above
};

/// A light, a receiver and the faces between them.
struct Stage {
  FaceSide light;  ///< the part above the receiver
  FaceSide receiver;
  std::vector<std::vector<Vec>> between;  ///< the parts of other faces above both
  double tolerance = 0;                   ///< shorter lengths are rounding errors
};

/// Creases on a receiver.
struct StageCreases {
  std::vector<Crease> borders;  ///< of penumbrae and umbrae
  std::vector<Crease> within;   ///< a penumbra: another corner of the light becomes visible
};

/// Intersections of the receiver with the light's own plane and with the critical planes of the
/// light and the faces between, unless other faces hide them; see find_creases() of a room.
StageCreases find_creases(const Stage& stage);

}  // namespace radiosity

#pragma once
// The creases that one light makes on one receiver.

#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// A side of a face that light leaves or reaches.
struct FaceSide {
  std::vector<Vec> corners;  ///< counter-clockwise
  Plane plane;               ///< the side is above
};

/// One light, one receiver and what is between them.
struct Stage {
  FaceSide light;  ///< the part above the receiver
  FaceSide receiver;
  std::vector<std::vector<Vec>> between;  ///< the parts of other faces that are above both
  double tolerance = 0;                   ///< lengths below are rounding
};

/// Creases on a receiver.
struct StageCreases {
  std::vector<Crease> borders;  ///< of penumbrae and umbrae
  std::vector<Crease> within;   ///< a penumbra: another corner of the light comes into sight
};

/// Where the critical planes of the light and of what is between, and the light's own plane, meet
/// the receiver, as far as no other face is before them; see find_creases() of a room.
StageCreases find_creases(const Stage& stage);

}  // namespace radiosity

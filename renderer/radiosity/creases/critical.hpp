#pragma once
// What one light, one receiver and all that is between them make of creases: the critical planes
// (edge and corner) of G. Drettakis and E. Fiume, "A Fast Shadow Algorithm for Area Light Sources
// Using Backprojection", SIGGRAPH 1994, as far as they touch both light and blocker.

#include "renderer/radiosity/room/planar.hpp"
#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// A side of a face that light leaves or reaches.
struct Side {
  std::vector<Vec> corners;  ///< counter-clockwise
  Plane plane;               ///< the side is above
};

struct Stage {
  Side light;  ///< what of it is above the receiver
  Side receiver;
  std::vector<std::vector<Vec>> between;  ///< of other faces what is above both
  double tolerance = 0;                   ///< lengths below are rounding
};

/// Creases that between[blocker] makes on the receiver: where the planes through an edge of light
/// or blocker and a corner of the other that cut neither (on one side of such a plane the blocker
/// hides nothing of the light, or all it can) meet the receiver; where the blocker's own plane
/// does, if it cuts the light; and where the blocker touches the receiver. Only what no other face
/// hides from the light.
void add_shadow_creases(const Stage& stage, std::size_t blocker, std::vector<Crease>& creases);

/// The crease where the light's own plane cuts the receiver: it shines on one side only.
void add_horizon_crease(const Stage& stage, std::vector<Crease>& creases);

}  // namespace radiosity

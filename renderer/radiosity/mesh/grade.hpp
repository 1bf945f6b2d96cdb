#pragma once
// Finer patches near lights.

#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// Halves rows of the patches of faces with 4 corners (as many as `refine` times their own, or
/// Face::grid) until none is longer, along either side, than half its distance from a light that it
/// can see but for what is between, three times at most: there illumination changes over that
/// distance.
void grade_near_lights(Room& room, int refine);

}  // namespace radiosity

#pragma once
// Finer patches near lights.

#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// If Room::fine_near_lights, and then not again: sets Face::grid of faces with 4 corners that
/// reflect, from the grid that they have with `refine`, so that no patch is longer, along either
/// side, than half the distance from its middle to a light before it: over that distance
/// illumination changes. Rows are halved for it, three times at most. What is between light and
/// patch, and mirrors, are not looked at.
void grade_near_lights(Room& room, int refine);

}  // namespace radiosity

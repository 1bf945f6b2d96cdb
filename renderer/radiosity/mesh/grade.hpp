#pragma once
// Finer patches near lights.

#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// The room with finer grids (Face::grid, from what the faces have with `refine`) on faces of 4
/// corners that reflect. Rows of patches are halved where the illumination from the lights, if
/// nothing were between, is in the middle of a side of a patch far from the mean of its two ends:
/// by more than a fifth of the room's mean illumination. Twice at most, and as long as the room has
/// no more than twice as many patches.
Room make_graded(Room room, int refine);

}  // namespace radiosity

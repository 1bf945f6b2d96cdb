#pragma once
// Finer patches near lights.

#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// The room with finer grids (Face::grid, from what the faces have with `refine`) on faces of 4
/// corners that reflect. Rows of patches are halved where the illumination from the lights, if
/// nothing were between, is in the middle of a side of a patch off the mean of its two ends by more
/// than a fifth of the mean illumination that the room would have if it were closed: a light that
/// is narrower than a patch and near its middle may not be noticed. Twice at most; where the room
/// had more than twice as many patches, or 10 million, it is not halved.
Room make_graded(Room room, int refine);

}  // namespace radiosity

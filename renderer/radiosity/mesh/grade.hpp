#pragma once
// Refinement of patches near lights.

#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// Refines the grids (Face::grid) of reflecting faces with 4 corners, starting from the grids for
/// `refine`. Halves a row of patches if the unoccluded illumination at the middle of a patch's side
/// deviates too much from the mean of the side's ends. The limit is a fifth of the mean
/// illumination that the room would have if it were closed. A light that is narrower than a patch
/// and near the middle of one may be missed. Rows are halved at most twice. The room gets at most
/// twice as many patches, and at most 10 million.
Room make_graded(Room room, int refine);

}  // namespace radiosity

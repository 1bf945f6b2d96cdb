#pragma once
// Refinement of patches near lights, where the illumination varies strongly.

#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// Refines the grids (Face::grid) of reflecting faces with 4 corners, starting from the grids for
/// `refine`. Compares the illumination without occlusion at the middle of each patch's side with
/// the mean of the side's ends. If they differ by more than a fifth of the room's mean
/// illumination, halves the row of patches. (The mean is computed as if the room were closed.) A
/// light that is narrower than a patch and near its middle may be missed. Rows are halved at most
/// twice. The room gets at most twice as many patches, and at most 10 million.
Room make_graded(Room room, int refine);

}  // namespace radiosity

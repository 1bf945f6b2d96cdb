#pragma once
// Finer patches near lights.

#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// Refines grids (Face::grid, from the faces' grids with `refine`) on reflecting faces of 4
/// corners. Halves a row of patches if the unoccluded illumination at the middle of a patch's side
/// deviates too much from the mean of its ends. The limit is a fifth of the room's mean
/// illumination, as if it were closed. Lights near the middle and narrower than a patch may be
/// missed. It halves at most twice, and never to more than twice as many patches, or 10 million.
Room make_graded(Room room, int refine);

}  // namespace radiosity

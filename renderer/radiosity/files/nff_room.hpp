#pragma once
// Rooms from NFF files.

#include <istream>
#include <string>

#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// Reads NFF (renderer/files/nff.hpp). Faces are p and pp; the surface f before them is diffuse and
/// reflects kd times its colour, or where ks is 1 and kd 0 a mirror that reflects all. Its
/// highlights are passed over, as are l and b. `# emit R G B` after an f: the faces from there on
/// emit. BadInput for spheres and cones, which are not flat, and for T above 0.
Room read_nff_room(std::istream& in, const std::string& name);

}  // namespace radiosity

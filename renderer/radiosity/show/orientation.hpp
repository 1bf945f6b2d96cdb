#pragma once
// Faces that probably point the wrong way, mostly because of the order of their corners.

#include <string>
#include <vector>

#include "renderer/radiosity/mesh/mesh.hpp"

namespace radiosity {

/// A sentence for each problem. One is a camera that sees more (black) backs of one-sided faces
/// than fronts. Others are one-sided lamps that shine into a wall or out of the room, with
/// something to light behind them. `mesh` is made from the room.
std::vector<std::string> find_turned_faces(const Room& room, const Mesh& mesh);

}  // namespace radiosity

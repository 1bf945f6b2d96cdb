#pragma once
// Faces that probably look the wrong way: the commonest mistake with the order of corners.

#include <string>
#include <vector>

#include "renderer/radiosity/mesh/mesh.hpp"

namespace radiosity {

/// A sentence for each: a camera that sees more backs of one-sided faces, which are black, than
/// fronts; and one-sided lamps that shine into a wall or out of the room, while behind them is
/// something to light. `mesh` is made of the room.
std::vector<std::string> find_turned_faces(const Room& room, const Mesh& mesh);

}  // namespace radiosity

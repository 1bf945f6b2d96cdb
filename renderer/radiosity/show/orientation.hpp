#pragma once
// Detection of faces that probably face the wrong way, because of the order of their corners.

#include <string>
#include <vector>

#include "renderer/radiosity/mesh/mesh.hpp"

namespace radiosity {

/// Returns a sentence for each problem found. First, the camera should see more fronts of faces
/// than backs, which are black. Second, a one-sided lamp should not shine into a wall or out of the
/// room if it would light something at its other side. `mesh` is a mesh of the room.
std::vector<std::string> find_turned_faces(const Room& room, const Mesh& mesh);

}  // namespace radiosity

#pragma once
// Detection of faces that probably point the wrong way, mostly because of the order of their
// corners.

#include <string>
#include <vector>

#include "renderer/radiosity/mesh/mesh.hpp"

namespace radiosity {

/// Returns a sentence for each problem. More fronts than (black) backs of faces should be visible
/// from the camera. A one-sided lamp should not shine into a wall or out of the room while
/// something behind it could be lit. `mesh` is made from the room.
std::vector<std::string> find_turned_faces(const Room& room, const Mesh& mesh);

}  // namespace radiosity

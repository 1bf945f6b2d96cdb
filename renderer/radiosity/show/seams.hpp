#pragma once
// Seams between coplanar faces with different divisions. An edge of a patch on one side is several
// edges on the other, and both surfaces must agree there.

#include <span>

#include "renderer/radiosity/mesh/mesh.hpp"

namespace radiosity {

/// An edge of a patch, and the vertices of other patches on it.
struct Seam {
  struct Stop {
    std::uint32_t vertex = 0;
    double share = 0;  ///< position of the vertex on the edge, 0 to 1
  };
  std::uint32_t from = 0, to = 0;
  std::vector<Stop> stops;  ///< vertices on the edge in order, without its ends
};

/// Finds the seams of a mesh. A seam comes before those that end on it, unless they form a cycle.
/// `twins` is as Fans::twins. Both ends of a seam are vertices of both faces. If neither division
/// contains the other, as with 3 and 5 parts, there are seams only between common vertices.
std::vector<Seam> find_seams(const Mesh& mesh, std::span<const std::uint32_t> twins);

}  // namespace radiosity

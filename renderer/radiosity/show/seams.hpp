#pragma once
// Seams between faces in one plane that are divided differently. An edge of a patch on one side is
// several edges on the other side, and the surfaces of both sides must have equal values there.

#include <span>

#include "renderer/radiosity/mesh/mesh.hpp"

namespace radiosity {

/// An edge of a patch, with the vertices of other patches that lie on it.
struct Seam {
  struct Stop {
    std::uint32_t vertex = 0;
    double share = 0;  ///< position on the edge, 0 to 1
  };
  std::uint32_t from = 0, to = 0;
  std::vector<Stop> stops;  ///< in the order along the edge, without its ends
};

/// Finds the seams of a mesh. A seam comes before the seams that end on it, unless they form a
/// cycle. `twins` is as Fans::twins in slopes.hpp. Both ends of a seam are vertices of both faces.
/// If neither division contains the other, as with 3 and 5 parts, there are seams only between
/// common vertices.
std::vector<Seam> find_seams(const Mesh& mesh, std::span<const std::uint32_t> twins);

}  // namespace radiosity

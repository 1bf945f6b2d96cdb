#pragma once
// Where two faces of one plane meet that are divided unlike: an edge of one's patch is several of
// the other's, and its surface there must be theirs.

#include <span>

#include "renderer/radiosity/mesh/mesh.hpp"

namespace radiosity {

/// A patch's edge and the vertices of others on it.
struct Seam {
  struct Stop {
    std::uint32_t vertex = 0;
    double share = 0;  ///< of the way, 0 to 1
  };
  std::uint32_t from = 0, to = 0;
  std::vector<Stop> stops;  ///< in their order; without the ends
};

/// The seams of a mesh; one on which others end comes before these, unless they end on each other
/// in a circle. `twins` as Fans::twins. Both ends of a seam are vertices of both faces: divisions
/// of which neither holds the other, as in 3 and in 5, make seams only where they do.
std::vector<Seam> find_seams(const Mesh& mesh, std::span<const std::uint32_t> twins);

}  // namespace radiosity

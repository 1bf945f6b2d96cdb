#pragma once
// Distribution of the patches over the processors (thesis 5.1: in AMP equally many each).
#include "renderer/radiosity/light/solve.hpp"

namespace parallel_radiosity {

enum class Distribution : std::uint8_t {
  blocks,  ///< equally many consecutive patches: whole walls, or strips of them
  tiles,   ///< an equal share of every face, as compact as possible
  work,    ///< consecutive patches of equal estimated work: number of patches they face
};

/// Vertices whose light one processor sends to another in every shot.
struct Border {
  int other = 0;
  std::vector<std::uint32_t> vertices;  ///< ascending
};

/// A processor's part of the mesh.
struct Share {
  std::vector<std::uint32_t> patches;   ///< ascending
  std::vector<std::uint32_t> vertices;  ///< it computes their light; ascending
  std::vector<Border> out, in;          ///< by number of the other processor
};

/// One share per processor; every patch is in exactly one. A share's vertices are the corners of
/// its patches, so border vertices are in several shares.
std::vector<Share> distribute(const radiosity::Mesh& mesh, int processors, Distribution how);

/// Assigns each vertex to one of its processors, in turns; that one sends the light to the others.
void exchange_borders(std::vector<Share>& shares, std::size_t vertices);

}  // namespace parallel_radiosity

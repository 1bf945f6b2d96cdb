#pragma once
// Distribution of patches over processors. AMP distributes equal numbers (thesis 5.1).
#include "renderer/radiosity/light/solve.hpp"

namespace parallel_radiosity {

enum class Distribution : std::uint8_t {
  blocks,  ///< equal numbers of consecutive patches: whole walls, or strips of them
  tiles,   ///< equal parts of every face, as compact as possible
  work,    ///< consecutive patches of equal total work, estimated from the patches they face
};

/// Vertices shared by two processors. In every shot, one of them sends the other the light of these
/// vertices.
struct Border {
  int other = 0;
  std::vector<std::uint32_t> vertices;  ///< in ascending order
};

/// The part of the mesh assigned to a processor.
struct Share {
  std::vector<std::uint32_t> patches;   ///< in ascending order
  std::vector<std::uint32_t> vertices;  ///< corners of its patches, in ascending order
  std::vector<Border> out, in;          ///< border vertices to send and to receive
};

/// Assigns each patch to one processor and returns the processors' shares. The vertices of a share
/// are the corners of its patches, so border vertices belong to several shares.
std::vector<Share> distribute(const radiosity::Mesh& mesh, int processors, Distribution how);

/// Assigns each shared vertex to one of its processors, in rotation. This processor computes the
/// vertex's light and sends it to the others.
void exchange_borders(std::vector<Share>& shares, std::size_t vertices);

}  // namespace parallel_radiosity

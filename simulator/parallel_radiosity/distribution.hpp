#pragma once
// Distribution of patches over processors. The thesis's radiosity system AMP gives all processors
// equal numbers of patches (5.1).
#include "renderer/radiosity/light/solve.hpp"

namespace parallel_radiosity {

enum class Distribution : std::uint8_t {
  blocks,  ///< equal numbers of consecutive patches: whole walls, or strips of walls
  tiles,   ///< an equal part of every face, as compact as possible
  work,    ///< consecutive patches of equal work, estimated from the patches they face
};

/// Vertices shared with another processor. In every shot, one of the two processors sends the other
/// the light of these vertices.
struct Border {
  int other = 0;
  std::vector<std::uint32_t> vertices;  ///< numbers of the shared vertices, in ascending order
};

/// The part of the mesh assigned to a processor.
struct Share {
  std::vector<std::uint32_t> patches;  ///< numbers of its patches, in ascending order
  /// Numbers of the corners of its patches, in ascending order.
  std::vector<std::uint32_t> vertices;
  /// Shared vertices whose light is sent to, or received from, other processors.
  std::vector<Border> out, in;
};

/// Assigns each patch to one processor, and returns the share of each processor. The corners of a
/// processor's patches are its vertices, so a vertex on a border belongs to several shares.
std::vector<Share> distribute(const radiosity::Mesh& mesh, int processors, Distribution how);

/// Decides for each shared vertex which of its processors computes the vertex's light and sends it
/// to the others. The choice rotates among the processors.
void exchange_borders(std::vector<Share>& shares, std::size_t vertices);

}  // namespace parallel_radiosity

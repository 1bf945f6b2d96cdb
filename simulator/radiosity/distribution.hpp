#pragma once
// Which processor has which patches (thesis 5.1: in AMP all have equally many).
#include "renderer/radiosity/light/solve.hpp"

namespace amp {

enum class Distribution : std::uint8_t {
  blocks,  ///< equal counts of consecutive patches: whole walls, or strips of them
  tiles,   ///< an equal share of every face, as compact as can be
  work,    ///< consecutive patches of equal estimated work: how many others they face
};

/// Vertices whose light one processor tells another in every shot.
struct Border {
  int other = 0;
  std::vector<std::uint32_t> vertices;  ///< ascending
};

/// What a processor has.
struct Share {
  std::vector<std::uint32_t> patches;   ///< ascending
  std::vector<std::uint32_t> vertices;  ///< it finds their light; ascending
  std::vector<Border> out, in;          ///< by the other's number
};

/// A share for each of `processors`; every patch is in one share. A share's vertices are the
/// corners of its patches: those on borders are in several shares.
std::vector<Share> distribute(const radiosity::Mesh& mesh, int processors, Distribution how);

/// Leaves each vertex to one of the processors that have it, in turns; that one tells the others.
void exchange_borders(std::vector<Share>& shares, std::size_t vertices);

}  // namespace amp

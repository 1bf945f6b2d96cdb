#pragma once
// Which processor has which patches (thesis 5.1: in AMP each has as many).
#include "renderer/radiosity/solve.hpp"

namespace amp {

enum class Distribution : std::uint8_t {
  blocks,  // equal counts of consecutive patches: whole walls, or strips of them
  tiles,   // of every face an equal share, as compact as can be
  work,    // consecutive patches of equal estimated work: how many others they face
};

// What a processor has: its patches, and their corners. Corners between two processors' patches are
// found by both.
struct Share {
  std::vector<std::uint32_t> patches, vertices;  // ascending
};

// Of each of `processors`; every patch is in one share.
std::vector<Share> distribute(const radiosity::Mesh& mesh, int processors, Distribution how);

}  // namespace amp

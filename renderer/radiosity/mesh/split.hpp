#pragma once
// Vertices at the borders of smooth surfaces: lit a little inside, and doubled along creases.

#include <set>

#include "renderer/radiosity/mesh/mesh.hpp"

namespace radiosity {

/// Edges between vertices, the lower index first.
using Edges = std::set<std::pair<std::uint32_t, std::uint32_t>>;

/// Sets Vertex::lit of all vertices on an edge of one patch only (MeshParams::inset).
void inset_borders(Mesh& mesh, double inset);

/// Gives every group of patches that creases divide around a vertex a vertex of its own; copies
/// have the same place, and so the same illumination.
void split_at_creases(Mesh& mesh, const Edges& creases);

/// The patches around every vertex, in order: those of vertex v are `patches` from first[v] to
/// first[v + 1].
struct Surroundings {
  std::vector<std::uint32_t> first, patches;
  std::span<const std::uint32_t> of(std::uint32_t vertex) const {
    return std::span(patches).subspan(first[vertex], first[vertex + 1] - first[vertex]);
  }
};
Surroundings find_surroundings(const Mesh& mesh);

}  // namespace radiosity

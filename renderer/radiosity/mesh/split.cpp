#include "renderer/radiosity/mesh/split.hpp"

#include <algorithm>
#include <map>
#include <numeric>

namespace radiosity {

namespace {

std::pair<std::uint32_t, std::uint32_t> edge_of(const Patch& patch, std::size_t side) {
  return std::minmax(patch.corners[side], patch.corners[(side + 1) % 4]);
}

std::size_t corner_at(const Patch& patch, std::uint32_t vertex) {
  return static_cast<std::size_t>(std::ranges::find(patch.corners, vertex) - patch.corners.begin());
}

// Whether the patches share an edge at the vertex that is no crease.
bool are_joined(const Patch& a, const Patch& b, std::uint32_t vertex, const Edges& creases) {
  const auto i = corner_at(a, vertex), j = corner_at(b, vertex);
  for (const auto side : {i, (i + 3) % 4})
    for (const auto other : {j, (j + 3) % 4})
      if (edge_of(a, side) == edge_of(b, other) && !creases.contains(edge_of(a, side))) return true;
  return false;
}

// The group of each patch around a vertex: the index of the group's first patch.
std::vector<std::size_t> find_groups(const Mesh& mesh, std::span<const std::uint32_t> around,
                                     std::uint32_t vertex, const Edges& creases) {
  std::vector<std::size_t> group(around.size());
  std::iota(group.begin(), group.end(), std::size_t{0});
  for (std::size_t a = 0; a < around.size(); ++a)
    for (std::size_t b = a + 1; b < around.size(); ++b)
      if (group[a] != group[b] &&
          are_joined(mesh.patches[around[a]], mesh.patches[around[b]], vertex, creases)) {
        const auto [low, high] = std::minmax(group[a], group[b]);
        std::ranges::replace(group, high, low);
      }
  return group;
}

}  // namespace

Surroundings find_surroundings(const Mesh& mesh) {
  Surroundings found;
  found.first.assign(mesh.vertices.size() + 1, 0);
  for (const Patch& patch : mesh.patches)
    for (const auto corner : patch.corners) ++found.first[corner + 1];
  std::partial_sum(found.first.begin(), found.first.end(), found.first.begin());
  found.patches.resize(found.first.back());
  auto next = found.first;
  for (std::uint32_t i = 0; i < mesh.patches.size(); ++i)
    for (const auto corner : mesh.patches[i].corners) found.patches[next[corner]++] = i;
  return found;
}

void inset_borders(Mesh& mesh, double inset) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  for (const Patch& patch : mesh.patches)
    for (std::size_t side = 0; side < 4; ++side) ++sides[edge_of(patch, side)];
  std::vector<bool> is_border(mesh.vertices.size());
  for (const auto& [edge, count] : sides)
    if (count == 1) is_border[edge.first] = is_border[edge.second] = true;
  const auto surroundings = find_surroundings(mesh);
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    if (!is_border[v]) continue;
    const auto around = surroundings.of(v);
    Vec centre;
    for (const auto patch : around)
      centre += (1.0 / static_cast<double>(around.size())) * mesh.patches[patch].centre;
    mesh.vertices[v].lit = mesh.vertices[v].at + inset * (centre - mesh.vertices[v].at);
  }
}

void split_at_creases(Mesh& mesh, const Edges& creases) {
  const auto surroundings = find_surroundings(mesh);
  std::set<std::uint32_t> touched;
  for (const auto& [a, b] : creases) touched.insert({a, b});
  for (const auto vertex : touched) {
    const auto around = surroundings.of(vertex);
    const auto group = find_groups(mesh, around, vertex, creases);
    std::map<std::size_t, std::uint32_t> vertex_of{{0, vertex}};
    for (std::size_t i = 0; i < around.size(); ++i) {
      const auto [known, added] =
          vertex_of.emplace(group[i], static_cast<std::uint32_t>(mesh.vertices.size()));
      if (added) mesh.vertices.push_back(Vertex(mesh.vertices[vertex]));
      auto& patch = mesh.patches[around[i]];
      patch.corners[corner_at(patch, vertex)] = known->second;
    }
  }
}

}  // namespace radiosity

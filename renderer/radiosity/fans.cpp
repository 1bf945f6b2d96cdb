#include "renderer/radiosity/fans.hpp"

#include <algorithm>

namespace radiosity {
namespace {

// Every wedge at its vertex, in the order of the patches: a counting sort.
void sort_wedges(const Mesh& mesh, Fans& fans) {
  fans.first.assign(mesh.vertices.size() + 1, 0);
  for (const Patch& patch : mesh.patches)
    for (const std::uint32_t v : patch.corners) ++fans.first[v + 1];
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) fans.first[v + 1] += fans.first[v];
  fans.wedges.resize(4 * mesh.patches.size());
  std::vector<std::uint32_t> free = fans.first;
  for (std::uint32_t p = 0; p < mesh.patches.size(); ++p) {
    const auto& corners = mesh.patches[p].corners;
    for (std::uint32_t c = 0; c < 4; ++c)
      fans.wedges[free[corners[c]]++] = {p,     c,    corners[(c + 1) % 4], corners[(c + 3) % 4],
                                         false, false};
  }
}

// Patches run counter-clockwise: what is next in one is previous in the other.
void mark_inner(std::span<Wedge> wedges) {
  for (Wedge& a : wedges)
    for (Wedge& b : wedges)
      if (a.next == b.prev) a.next_inner = b.prev_inner = true;
}

// Within 8 degrees.
bool is_straight(const Vec& a, const Vec& b) {
  return dot(a, b) < -0.99 * std::sqrt(dot(a, a) * dot(b, b));
}

Place find_place(const Mesh& mesh, std::size_t vertex, std::span<const Wedge> wedges) {
  if (wedges.empty()) return Place::corner;
  std::array<Vec, 2> ends;
  std::size_t borders = 0;
  const auto add_border = [&](std::uint32_t neighbour) {
    if (borders < 2) ends[borders] = unfold(mesh.vertices[vertex], mesh.vertices[neighbour].at);
    ++borders;
  };
  for (const Wedge& w : wedges) {
    if (!w.next_inner) add_border(w.next);
    if (!w.prev_inner) add_border(w.prev);
  }
  if (borders == 0) return Place::inner;
  return borders == 2 && is_straight(ends[0], ends[1]) ? Place::straight : Place::corner;
}

}  // namespace

Vec unfold(const Vertex& vertex, const Vec& to) {
  const Vec edge = to - vertex.at;
  const Vec flat = edge - dot(edge, vertex.normal) * vertex.normal;
  const double squared = dot(flat, flat);
  return squared > 0 ? std::sqrt(dot(edge, edge) / squared) * flat : Vec{};
}

Fans make_fans(const Mesh& mesh) {
  Fans fans;
  sort_wedges(mesh, fans);
  fans.places.reserve(mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    mark_inner(std::span(fans.wedges).subspan(fans.first[v], fans.first[v + 1] - fans.first[v]));
    fans.places.push_back(find_place(mesh, v, fans.at(v)));
  }
  return fans;
}

}  // namespace radiosity

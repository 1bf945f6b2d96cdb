#include "renderer/radiosity/fans.hpp"

#include <algorithm>

#include "renderer/radiosity/split.hpp"

namespace radiosity {
namespace {

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
  const Vertex& v = mesh.vertices[vertex];
  Vec after, before;  // the ends of the border here
  int starts = 0, ends = 0;
  for (const Wedge& w : wedges) {
    if (!w.next_inner) {
      after = unfold(v, mesh.vertices[w.next].at);
      ++starts;
    }
    if (!w.prev_inner) {
      before = unfold(v, mesh.vertices[w.prev].at);
      ++ends;
    }
  }
  if (starts + ends == 0 && !wedges.empty()) return Place::inner;
  return starts == 1 && ends == 1 && is_straight(after, before) ? Place::straight : Place::corner;
}

}  // namespace

Vec unfold(const Vertex& vertex, const Vec& to) {
  const Vec edge = to - vertex.at;
  const Vec flat = edge - dot(edge, vertex.normal) * vertex.normal;
  const double squared = dot(flat, flat);
  return squared > 0 ? std::sqrt(dot(edge, edge) / squared) * flat : Vec{};
}

Fans make_fans(const Mesh& mesh) {
  Surroundings around = find_surroundings(mesh);
  Fans fans;
  fans.wedges.reserve(around.patches.size());
  fans.places.reserve(mesh.vertices.size());
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    for (const std::uint32_t p : around.of(v)) {
      const auto& corners = mesh.patches[p].corners;
      const auto c = static_cast<std::uint32_t>(std::ranges::find(corners, v) - corners.begin());
      fans.wedges.push_back({p, c, corners[(c + 1) % 4], corners[(c + 3) % 4], false, false});
    }
    const std::span wedges = std::span(fans.wedges).subspan(around.first[v]);
    mark_inner(wedges);
    fans.places.push_back(find_place(mesh, v, wedges));
  }
  fans.first = std::move(around.first);
  return fans;
}

}  // namespace radiosity

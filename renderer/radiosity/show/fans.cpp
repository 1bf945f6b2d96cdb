#include "renderer/radiosity/show/fans.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "renderer/radiosity/mesh/split.hpp"

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

// Within 45 degrees of straight on.
double trust_edge(const Mesh& mesh, const Vertex& v, std::span<const Wedge> wedges,
                  std::uint32_t neighbour) {
  const Vec edge = unfold(v, mesh.vertices[neighbour].at);
  double longest = 0;
  for (const Wedge& w : wedges)
    for (const std::uint32_t n : {w.next, w.prev}) {
      const Vec other = unfold(v, mesh.vertices[n].at);
      if (dot(edge, other) < -0.7 * length(edge) * length(other))
        longest = std::max(longest, length(other));
    }
  return find_trust(length(edge), longest);
}

Place find_place(const Mesh& mesh, std::size_t vertex, std::span<const Wedge> wedges) {
  const auto is_inner = [](const Wedge& w) { return w.next_inner && w.prev_inner; };
  if (!wedges.empty() && std::ranges::all_of(wedges, is_inner)) return Place::inner;
  const auto border = find_border(wedges);
  if (!border) return Place::corner;
  const Vertex& v = mesh.vertices[vertex];
  return is_straight(unfold(v, mesh.vertices[border->after].at),
                     unfold(v, mesh.vertices[border->before].at))
             ? Place::straight
             : Place::corner;
}

auto sort_key(const Vertex& v) {
  return std::tuple(v.at.x, v.at.y, v.at.z, v.normal.x, v.normal.y, v.normal.z, v.material);
}

std::vector<std::uint32_t> find_twins(const Mesh& mesh) {
  const auto& vertices = mesh.vertices;
  std::vector<std::uint32_t> order(vertices.size()), twins(vertices.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::sort(order, {},
                    [&](std::uint32_t v) { return std::tuple(sort_key(vertices[v]), v); });
  for (std::size_t first = 0, end = 0; first < order.size(); first = end) {
    while (end < order.size() && are_twins(vertices[order[first]], vertices[order[end]])) ++end;
    for (std::size_t i = first; i < end; ++i) twins[order[i]] = order[i + 1 < end ? i + 1 : first];
  }
  return twins;
}

}  // namespace

double find_trust(double edge, double other) {
  const double share = other > 0 ? std::min(1.0, 3 * edge / other) : 1.0;
  return share * share;
}

bool are_twins(const Vertex& a, const Vertex& b) { return sort_key(a) == sort_key(b); }

std::optional<Border> find_border(std::span<const Wedge> wedges) {
  Border border;
  int starts = 0, ends = 0;
  for (const Wedge& w : wedges) {
    if (!w.next_inner) {
      border.after = w.next;
      ++starts;
    }
    if (!w.prev_inner) {
      border.before = w.prev;
      ++ends;
    }
  }
  return starts == 1 && ends == 1 ? std::optional(border) : std::nullopt;
}

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
      fans.wedges.push_back({p, c, corners[(c + 1) % 4], corners[(c + 3) % 4], false, false, 1});
    }
    const std::span wedges = std::span(fans.wedges).subspan(around.first[v]);
    mark_inner(wedges);
    for (Wedge& w : wedges)
      w.trust = trust_edge(mesh, mesh.vertices[v], wedges, w.next) *
                trust_edge(mesh, mesh.vertices[v], wedges, w.prev);
    fans.places.push_back(find_place(mesh, v, wedges));
  }
  fans.first = std::move(around.first);
  fans.twins = find_twins(mesh);
  return fans;
}

}  // namespace radiosity

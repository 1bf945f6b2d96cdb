#include "renderer/radiosity/slopes.hpp"

namespace radiosity {
namespace {

struct Finder {
  const Mesh& mesh;
  const Fans& fans;
  std::span<const Rgb> vertices;
  std::vector<Slopes<Rgb>> slopes;
};

Rgb difference(const Finder& f, std::uint32_t from, std::uint32_t to) {
  return f.vertices[to] + -1.0 * f.vertices[from];
}

// Whether the far end of an edge knows its slope along it before this end does. Vertices inside
// come first, then straight borders, which are of use to corners only.
bool is_known(const Finder& f, std::uint32_t vertex, std::uint32_t neighbour, bool inner_edge) {
  switch (f.fans.places[vertex]) {
    case Place::inner:
      return false;
    case Place::straight:
      return inner_edge && f.fans.places[neighbour] == Place::inner;
    case Place::corner:
      return f.fans.places[neighbour] != Place::corner;
  }
  return false;
}

// The change along an edge at its beginning. Of the parabola through both ends with the slope m at
// the far one, in the edge's direction: 2 (B_1 - B_0) - m.
Rgb find_change(const Finder& f, std::uint32_t vertex, std::uint32_t neighbour, bool inner_edge) {
  const Rgb whole = difference(f, vertex, neighbour);
  if (!is_known(f, vertex, neighbour, inner_edge)) return whole;
  const Vec back = unfold(f.mesh.vertices[neighbour], f.mesh.vertices[vertex].at);
  return 2.0 * whole + along(f.slopes[neighbour], back);
}

// Replaces the slope along a straight border by that of the parabola through its three vertices.
void follow_border(const Finder& f, std::uint32_t vertex, Slopes<Rgb>& slopes) {
  std::uint32_t a = vertex, b = vertex;  // the neighbours after it and before it on the border
  for (const Wedge& w : f.fans.at(vertex)) {
    if (!w.next_inner) a = w.next;
    if (!w.prev_inner) b = w.prev;
  }
  const Vertex& v = f.mesh.vertices[vertex];
  const Vec to_a = unfold(v, f.mesh.vertices[a].at), to_b = unfold(v, f.mesh.vertices[b].at);
  const double share_a = 1 / dot(to_a, to_a), share_b = 1 / dot(to_b, to_b);
  const Vec way = share_a * to_a + -share_b * to_b;
  const Rgb change = share_a * difference(f, vertex, a) + -share_b * difference(f, vertex, b);
  const Rgb missing = 1 / dot(way, way) * (change + -1.0 * along(slopes, way));
  slopes = slopes + Slopes<Rgb>{way.x * missing, way.y * missing, way.z * missing};
}

Slopes<Rgb> find_at(const Finder& f, std::uint32_t vertex) {
  const Vertex& v = f.mesh.vertices[vertex];
  MeanPlane<Rgb> mean;
  for (const Wedge& w : f.fans.at(vertex))
    mean.add(v.normal, unfold(v, f.mesh.vertices[w.next].at),
             find_change(f, vertex, w.next, w.next_inner), unfold(v, f.mesh.vertices[w.prev].at),
             find_change(f, vertex, w.prev, w.prev_inner));
  Slopes<Rgb> slopes = mean.get();
  if (f.fans.places[vertex] == Place::straight) follow_border(f, vertex, slopes);
  return slopes;
}

}  // namespace

std::vector<Slopes<Rgb>> find_slopes(const Mesh& mesh, const Fans& fans,
                                     std::span<const Rgb> vertices) {
  Finder f{mesh, fans, vertices, std::vector<Slopes<Rgb>>(mesh.vertices.size())};
  for (const Place place : {Place::inner, Place::straight, Place::corner})
    for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v)
      if (fans.places[v] == place) f.slopes[v] = find_at(f, v);
  return std::move(f.slopes);
}

}  // namespace radiosity

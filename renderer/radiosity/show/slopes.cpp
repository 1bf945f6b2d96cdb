#include "renderer/radiosity/show/slopes.hpp"

namespace radiosity {
namespace {

// Its slopes come to be: inside first, then on straight borders, then at corners.
struct Finder {
  const Mesh& mesh;
  const Fans& fans;
  std::span<const Rgb> vertices;
  std::vector<Slopes<Rgb>> slopes;
};

Rgb difference(const Finder& f, std::uint32_t from, std::uint32_t to) {
  return f.vertices[to] + -1.0 * f.vertices[from];
}

// The change along an edge, at its beginning, of the parabola through both ends with the slope m at
// the far one: 2 (B_1 - B_0) - m. `back` is the slope there, but towards here.
Rgb bend(const Rgb& whole, const Rgb& back) { return 2.0 * whole + back; }

// Along an edge that leads inside, at its beginning.
Rgb find_inner_change(const Finder& f, std::uint32_t vertex, std::uint32_t neighbour) {
  const Rgb whole = difference(f, vertex, neighbour);
  if (f.fans.places[neighbour] >= f.fans.places[vertex]) return whole;
  const Vec way = unfold(f.mesh.vertices[neighbour], f.mesh.vertices[vertex].at);
  return bend(whole, along(f.slopes[neighbour], way));
}

// Along a border to a neighbour, if it passes the vertex, or a twin of it, straight.
std::optional<Rgb> find_straight_change(const Finder& f, std::uint32_t vertex,
                                        std::uint32_t neighbour) {
  const Vertex& to = f.mesh.vertices[neighbour];
  std::uint32_t v = vertex;
  do {
    if (f.fans.places[v] == Place::straight) {
      const Border border = *find_border(f.fans.at(v));
      for (const std::uint32_t n : {border.after, border.before})
        if (are_twins(f.mesh.vertices[n], to))
          return along(f.slopes[v], unfold(f.mesh.vertices[v], to.at));
    }
    v = f.fans.twins[v];
  } while (v != vertex);
  return std::nullopt;
}

// Along a border, from its own vertices only: the same on both sides of a crease.
Rgb find_border_change(const Finder& f, std::uint32_t vertex, std::uint32_t neighbour) {
  if (const auto known = find_straight_change(f, vertex, neighbour)) return *known;
  const Rgb whole = difference(f, vertex, neighbour);
  const auto back = find_straight_change(f, neighbour, vertex);
  return back ? bend(whole, *back) : whole;
}

// Replaces the slope along a straight border by that of the parabola through its three vertices.
void follow_border(const Finder& f, std::uint32_t vertex, const Border& border,
                   Slopes<Rgb>& slopes) {
  const Vertex& v = f.mesh.vertices[vertex];
  const Vec a = unfold(v, f.mesh.vertices[border.after].at);
  const Vec b = unfold(v, f.mesh.vertices[border.before].at);
  const double la = length(a), lb = length(b);
  const double share_a = find_trust(la, lb) / (la * la), share_b = find_trust(lb, la) / (lb * lb);
  const Vec way = share_a * a + -share_b * b;
  const Rgb change = share_a * difference(f, vertex, border.after) +
                     -share_b * difference(f, vertex, border.before);
  const Rgb missing = 1 / dot(way, way) * (change + -1.0 * along(slopes, way));
  slopes = slopes + Slopes<Rgb>{way.x * missing, way.y * missing, way.z * missing};
}

// Replaces the slopes at a corner by those along its two borders, if these can tell.
void follow_borders(const Finder& f, std::uint32_t vertex, const Border& border,
                    Slopes<Rgb>& slopes) {
  const Vertex& v = f.mesh.vertices[vertex];
  const Vec a = unfold(v, f.mesh.vertices[border.after].at);
  const Vec b = unfold(v, f.mesh.vertices[border.before].at);
  const double sine = dot(v.normal, cross(a, b)) / std::sqrt(dot(a, a) * dot(b, b));
  if (!(std::abs(sine) > 0.5)) return;
  const Rgb to_a = find_border_change(f, vertex, border.after);
  const Rgb to_b = find_border_change(f, vertex, border.before);
  MeanPlane<Rgb> plane;
  sine > 0 ? plane.add(v.normal, a, to_a, b, to_b) : plane.add(v.normal, b, to_b, a, to_a);
  slopes = plane.get();
}

Slopes<Rgb> find_at(const Finder& f, std::uint32_t vertex) {
  const Vertex& v = f.mesh.vertices[vertex];
  const Place place = f.fans.places[vertex];
  const std::span wedges = f.fans.at(vertex);
  const auto find_change = [&](std::uint32_t neighbour, bool inner_edge) {
    if (inner_edge) return find_inner_change(f, vertex, neighbour);
    return place == Place::corner ? find_border_change(f, vertex, neighbour)
                                  : difference(f, vertex, neighbour);
  };
  MeanPlane<Rgb> mean;
  for (const Wedge& w : wedges)
    mean.add(v.normal, unfold(v, f.mesh.vertices[w.next].at), find_change(w.next, w.next_inner),
             unfold(v, f.mesh.vertices[w.prev].at), find_change(w.prev, w.prev_inner), w.trust);
  Slopes<Rgb> slopes = mean.get();
  if (const auto border = find_border(wedges)) {
    if (place == Place::straight)
      follow_border(f, vertex, *border, slopes);
    else
      follow_borders(f, vertex, *border, slopes);
  }
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

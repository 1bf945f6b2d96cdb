#include "renderer/radiosity/show/slopes.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "renderer/radiosity/mesh/mesh.hpp"

namespace radiosity {

namespace {

// The neighbours of a vertex on the border through it. On the way to `after`, the patches are on
// the left. There is no Border for an inner vertex, or if several borders meet.
struct Border {
  std::uint32_t after = 0, before = 0;
};
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

Wedge make_wedge(const Mesh& mesh, std::uint32_t patch, std::uint32_t vertex) {
  const auto& corners = mesh.patches[patch].corners;
  const auto corner =
      static_cast<std::uint32_t>(std::ranges::find(corners, vertex) - corners.begin());
  Wedge wedge{patch, corner, vertex, vertex};
  for (std::uint32_t step = 3; step > 0; --step) {
    const std::uint32_t ahead = corners[(corner + step) % 4];
    const std::uint32_t behind = corners[(corner + 4 - step) % 4];
    if (ahead != vertex) wedge.next = ahead;
    if (behind != vertex) wedge.prev = behind;
  }
  return wedge;
}

// Marks the inner edges. Corners are counter-clockwise, so that an inner edge is the next edge in
// one of its patches and the previous edge in the other.
void mark_inner(std::span<Wedge> wedges) {
  for (Wedge& a : wedges)
    for (Wedge& b : wedges)
      if (a.next == b.prev) a.next_inner = b.prev_inner = true;
}

// True if one direction is the straight continuation of the other, within 8 degrees.
bool is_straight(const Vec& a, const Vec& b) {
  return dot(a, b) < -0.99 * std::sqrt(dot(a, a) * dot(b, b));
}

// Weight of an edge with the length `edge`. `other` is the length of its continuation beyond the
// vertex. The weight is 1, or (3 edge / other)^2 if the edge is less than a third as long as its
// continuation. A small error of illumination at the end of a short edge makes a steep slope, and
// thus a large error in the patches of the long edge.
double find_trust(double edge, double other) {
  const double share = other > 0 ? std::min(1.0, 3 * edge / other) : 1.0;
  return share * share;
}

// The weight of the edge from `v` to a neighbour. Its continuation is the longest of the edges on
// the other side of `v` that go straight on, within 45 degrees.
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
  return std::tuple(v.at.x, v.at.y, v.at.z, v.lit.x, v.lit.y, v.lit.z, v.normal.x, v.normal.y,
                    v.normal.z, v.material);
}

// True if a crease has split the vertices. They then have the same position, lit point, normal and
// material, and hence the same illumination.
bool are_twins(const Vertex& a, const Vertex& b) { return sort_key(a) == sort_key(b); }

}  // namespace

Vec unfold(const Vertex& vertex, const Vec& to) {
  const Vec edge = to - vertex.at;
  const Vec flat = edge - dot(edge, vertex.normal) * vertex.normal;
  const double squared = dot(flat, flat);
  return squared > 0 ? std::sqrt(dot(edge, edge) / squared) * flat : Vec{};
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

Fans make_fans(const Mesh& mesh) {
  const Surroundings around = find_surroundings(mesh);
  Fans fans;
  fans.wedges.reserve(around.patches.size());
  fans.first.reserve(mesh.vertices.size() + 1);
  fans.places.reserve(mesh.vertices.size());
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    fans.first.push_back(static_cast<std::uint32_t>(fans.wedges.size()));
    for (const std::uint32_t p : around.of(v))
      if (fans.wedges.size() == fans.first[v] || fans.wedges.back().patch != p)
        fans.wedges.push_back(make_wedge(mesh, p, v));
    const std::span wedges = std::span(fans.wedges).subspan(fans.first[v]);
    mark_inner(wedges);
    for (Wedge& w : wedges)
      w.trust = trust_edge(mesh, mesh.vertices[v], wedges, w.next) *
                trust_edge(mesh, mesh.vertices[v], wedges, w.prev);
    fans.places.push_back(find_place(mesh, v, wedges));
  }
  fans.first.push_back(static_cast<std::uint32_t>(fans.wedges.size()));
  fans.twins = find_twins(mesh);
  return fans;
}

namespace {

// The mean of the tangent planes of a vertex's patches. `change(neighbour, inner)` returns the
// change of the quantity from the vertex to a neighbour; `inner` is false if the edge between them
// is on a border.
template <class T, class Change>
Slopes<T> eval_mean_plane(const Mesh& mesh, const Fans& fans, std::uint32_t vertex,
                          const Change& change) {
  const Vertex& v = mesh.vertices[vertex];
  MeanPlane<T> mean;
  for (const Wedge& w : fans.at(vertex))
    mean.add(v.normal, unfold(v, mesh.vertices[w.next].at), change(w.next, w.next_inner),
             unfold(v, mesh.vertices[w.prev].at), change(w.prev, w.prev_inner), w.trust);
  return mean.get();
}

// Finds the slopes of all vertices: first inside, then on straight borders, then at corners.
struct SlopeFinder {
  const Mesh& mesh;
  const Fans& fans;
  std::span<const Rgb> vertices;
  std::vector<Slopes<Rgb>> slopes;  // the slopes found so far, by vertex

  Rgb difference(std::uint32_t from, std::uint32_t to) const {
    return vertices[to] + -1.0 * vertices[from];
  }
  Vec way(std::uint32_t from, std::uint32_t to) const {
    return unfold(mesh.vertices[from], mesh.vertices[to].at);
  }

  // Extrapolates the change at the beginning of an edge by the parabola through both ends that has
  // the known slope m at the far end: 2 (B_1 - B_0) - m. `whole` is B_1 - B_0. `back` is -m, the
  // slope in the opposite direction.
  static Rgb bend(const Rgb& whole, const Rgb& back) { return 2.0 * whole + back; }

  // The change at the beginning of an edge that leads into the surface.
  Rgb find_inner_change(std::uint32_t vertex, std::uint32_t neighbour) const {
    const Rgb whole = difference(vertex, neighbour);
    if (fans.places[neighbour] >= fans.places[vertex]) return whole;
    return bend(whole, along(slopes[neighbour], way(neighbour, vertex)));
  }

  // The change along a border to a neighbour. None unless the border goes straight through the
  // vertex or one of its twins.
  std::optional<Rgb> find_straight_change(std::uint32_t vertex, std::uint32_t neighbour) const {
    const Vertex& to = mesh.vertices[neighbour];
    std::uint32_t v = vertex;
    do {
      if (fans.places[v] == Place::straight) {
        const Border border = *find_border(fans.at(v));
        for (const std::uint32_t n : {border.after, border.before})
          if (are_twins(mesh.vertices[n], to)) return along(slopes[v], way(v, neighbour));
      }
      v = fans.twins[v];
    } while (v != vertex);
    return std::nullopt;
  }

  // The change along a border. It depends only on vertices of the border, so that it is the same on
  // both sides of a crease.
  Rgb find_border_change(std::uint32_t vertex, std::uint32_t neighbour) const {
    if (const auto known = find_straight_change(vertex, neighbour)) return *known;
    const Rgb whole = difference(vertex, neighbour);
    const auto back = find_straight_change(neighbour, vertex);
    return back ? bend(whole, *back) : whole;
  }

  // Replaces the slope along a straight border by the slope of the parabola through the vertex and
  // its two neighbours on the border.
  void follow_border(std::uint32_t vertex, const Border& border, Slopes<Rgb>& at) const {
    const Vec a = way(vertex, border.after), b = way(vertex, border.before);
    const double la = length(a), lb = length(b);
    const double share_a = find_trust(la, lb) / (la * la), share_b = find_trust(lb, la) / (lb * lb);
    const Vec whole = share_a * a + -share_b * b;
    const Rgb change =
        share_a * difference(vertex, border.after) + -share_b * difference(vertex, border.before);
    const Rgb missing = 1 / dot(whole, whole) * (change + -1.0 * along(at, whole));
    at = at + Slopes<Rgb>{whole.x * missing, whole.y * missing, whole.z * missing};
  }

  // Replaces the slopes at a corner by those of the plane through its two borders, unless the
  // borders are nearly parallel.
  void follow_borders(std::uint32_t vertex, const Border& border, Slopes<Rgb>& at) const {
    const Vec& normal = mesh.vertices[vertex].normal;
    const Vec a = way(vertex, border.after), b = way(vertex, border.before);
    const double sine = dot(normal, cross(a, b)) / std::sqrt(dot(a, a) * dot(b, b));
    if (!(std::abs(sine) > 0.5)) return;
    const Rgb to_a = find_border_change(vertex, border.after);
    const Rgb to_b = find_border_change(vertex, border.before);
    MeanPlane<Rgb> plane;
    sine > 0 ? plane.add(normal, a, to_a, b, to_b) : plane.add(normal, b, to_b, a, to_a);
    at = plane.get();
  }

  Slopes<Rgb> find_at(std::uint32_t vertex) const {
    const Place place = fans.places[vertex];
    auto found = eval_mean_plane<Rgb>(mesh, fans, vertex, [&](std::uint32_t to, bool inner_edge) {
      if (inner_edge) return find_inner_change(vertex, to);
      return place == Place::corner ? find_border_change(vertex, to) : difference(vertex, to);
    });
    if (const auto border = find_border(fans.at(vertex)))
      place == Place::straight ? follow_border(vertex, *border, found)
                               : follow_borders(vertex, *border, found);
    return found;
  }
};

}  // namespace

std::vector<Slopes<Rgb>> find_slopes(const Mesh& mesh, const Fans& fans,
                                     std::span<const Rgb> vertices) {
  SlopeFinder finder{mesh, fans, vertices, std::vector<Slopes<Rgb>>(mesh.vertices.size())};
  for (const Place place : {Place::inner, Place::straight, Place::corner})
    for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v)
      if (fans.places[v] == place) finder.slopes[v] = finder.find_at(v);
  return std::move(finder.slopes);
}

namespace {

// Rotates the slopes by the smallest rotation that takes the unit normal `from` to `to`.
Slopes<Rgb> turn(const Slopes<Rgb>& slopes, const Vec& from, const Vec& to) {
  const double cosine = dot(from, to);
  if (!(cosine > -0.5)) return {};  // a larger rotation cannot occur within a patch
  const Rgb out = -1 / (1 + cosine) * along(slopes, to);
  const Vec both = from + to;
  return slopes + Slopes<Rgb>{both.x * out, both.y * out, both.z * out};
}

}  // namespace

Slopes<Slopes<Rgb>> find_bend(const Mesh& mesh, const Fans& fans,
                              std::span<const Slopes<Rgb>> slopes, std::uint32_t vertex) {
  return eval_mean_plane<Slopes<Rgb>>(mesh, fans, vertex, [&](std::uint32_t to, bool) {
    return turn(slopes[to], mesh.vertices[to].normal, mesh.vertices[vertex].normal) +
           -1.0 * slopes[vertex];
  });
}

Rgb find_twist(const Mesh& mesh, const Wedge& wedge, const Slopes<Rgb>& slopes,
               const Slopes<Slopes<Rgb>>& bend) {
  const auto& corners = mesh.patches[wedge.patch].corners;
  const Vertex& v = mesh.vertices[corners[wedge.corner]];
  const Vec next = mesh.vertices[wedge.next].at, prev = mesh.vertices[wedge.prev].at;
  const Vec opposite = mesh.vertices[corners[(wedge.corner + 2) % 4]].at;
  const Vec a = unfold(v, next), b = unfold(v, prev);
  // The two orders of differentiation must give one result, so their mean is used.
  const Rgb mixed = 0.5 * (along(along(bend, a), b) + along(along(bend, b), a));
  return mixed + along(slopes, (v.at - next) + (opposite - prev));
}

}  // namespace radiosity

#pragma once
// Derivatives of the illumination at every vertex: the tangent planes (thesis, 3.1.4.1), and the
// mixed derivatives of Eq 3.4, which do not follow from the planes. Both depend on the patches
// around each vertex and on the borders of the surface.

#include <optional>

#include "renderer/radiosity/mesh/mesh.hpp"

namespace radiosity {

/// The corner of a patch at a vertex. If a patch has two corners at one vertex, they share one
/// wedge. An edge is inner if two patches at the vertex share it; otherwise it is on a border.
struct Wedge {
  std::uint32_t patch = 0;
  std::uint32_t corner = 0;          ///< first of the patch's corners at the vertex, 0..3
  std::uint32_t next = 0, prev = 0;  ///< vertices at the other ends of the corner's two edges
  bool next_inner = false, prev_inner = false;
  double trust = 1;  ///< weight of the corner's plane in a mean of planes (see find_trust())
};

enum class Place : std::uint8_t {
  inner,     ///< completely surrounded by patches
  straight,  ///< on a border that goes straight through the vertex
  corner     ///< where borders turn or meet; also a vertex without patches
};

struct Fans {
  std::vector<Wedge> wedges;  ///< sorted by vertex, then by patch
  /// By vertex: index of its first wedge; the last entry is wedges.size().
  std::vector<std::uint32_t> first;
  std::vector<Place> places;  ///< by vertex
  /// Twins are vertices that creases have split from one vertex. They form a ring: twins[v] is the
  /// next twin of vertex v, or v itself if it has none.
  std::vector<std::uint32_t> twins;

  std::span<const Wedge> at(std::size_t vertex) const {
    return std::span(wedges).subspan(first[vertex], first[vertex + 1] - first[vertex]);
  }
};

Fans make_fans(const Mesh& mesh);
/// Computes Fans::twins.
std::vector<std::uint32_t> find_twins(const Mesh& mesh);

/// Calls f with a vertex and with each of its twins.
template <class F>
void for_twins(std::span<const std::uint32_t> twins, std::uint32_t vertex, const F& f) {
  std::uint32_t v = vertex;
  do {
    f(v);
    v = twins[v];
  } while (v != vertex);
}

/// The vector from a vertex to the point `to`, rotated into the vertex's tangent plane without a
/// change of length.
Vec unfold(const Vertex& vertex, const Vec& to);

/// The change of a quantity per unit step along x, y and z. For the illumination B, whose graph
/// over a surface with normal N_g has the normal N_i (figure 3.4), it is N_g - N_i, with N_i scaled
/// so that N_i . N_g = 1.
template <class T>
struct Slopes {
  T x{}, y{}, z{};
};

template <class T>
Slopes<T> operator+(const Slopes<T>& a, const Slopes<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
Slopes<T> operator*(double s, const Slopes<T>& a) {
  return {s * a.x, s * a.y, s * a.z};
}

/// The change for a step d in the vertex's tangent plane: thesis Eq 3.5, multiplied by d. It
/// includes the half-space rule, Eq 3.6 and 3.7: the slopes are n = (N_i x N_g) x N_g, with N_i as
/// in Slopes. The product n . d has the required sign and, if d is as long as the edge of its
/// patch, the required size.
template <class T>
T along(const Slopes<T>& slopes, const Vec& d) {
  return d.x * slopes.x + d.y * slopes.y + d.z * slopes.z;
}

/// The mean of the tangent planes of a vertex's patches. Normals are scaled to N_i . N_g = 1
/// instead of unit length, so that slopes are averaged. The mean does not depend on the unit of B
/// and is linear in B, so that colours can be treated one by one. The weights are sin / (
/// next
///
/// prev
/// ) (N. Max, "Weights for Computing Vertex Normals from Facet Normals", JGT 4(2), 1999),
/// multiplied by the trust of the planes. On an even grid, this is the arithmetic mean. On any grid
/// of parallel lines, it is exact for quadratic functions if neighbouring steps differ by a factor
/// of at most 3.
template <class T>
struct MeanPlane {
  Slopes<T> sum;
  double weight = 0;

  /// Adds the plane with the change `to_next` along the vector `next` and the change `to_prev`
  /// along `prev`. Both vectors are perpendicular to the unit normal, and are in counter-clockwise
  /// order.
  void add(const Vec& normal, const Vec& next, const T& to_next, const Vec& prev, const T& to_prev,
           double trust = 1) {
    const double sine = dot(normal, cross(next, prev));
    if (!(sine > 0)) return;
    const double share = trust / (dot(next, next) * dot(prev, prev));
    const Vec a = share * cross(prev, normal), b = share * cross(normal, next);
    sum = sum + Slopes<T>{a.x * to_next + b.x * to_prev, a.y * to_next + b.y * to_prev,
                          a.z * to_next + b.z * to_prev};
    weight += share * sine;
  }
  Slopes<T> get() const { return weight > 0 ? (1 / weight) * sum : Slopes<T>{}; }
};

/// Finds the slopes at every vertex from the illumination of all vertices. On borders, extrapolates
/// with a parabola if the neighbour's slope is known (thesis, below Eq 3.7), and otherwise uses the
/// difference. The slope along a border depends only on vertices of the border, so that creases
/// leave no gaps. Exceptions are vertices with several patches where the border turns by 8 to 30
/// degrees or by more than 150 degrees.
std::vector<Slopes<Rgb>> find_slopes(const Mesh& mesh, const Fans& fans,
                                     std::span<const Rgb> vertices);

/// The changes of the slopes around a vertex. They follow from the slopes of the vertex and its
/// neighbours, as slopes follow from illuminations. First, a neighbour's slopes are rotated as its
/// normal would be rotated to the vertex's normal.
Slopes<Slopes<Rgb>> find_bend(const Mesh& mesh, const Fans& fans,
                              std::span<const Slopes<Rgb>> slopes, std::uint32_t vertex);

/// The mixed derivative at a corner of a patch, in the directions of its edges to `next` and
/// `prev`, multiplied by the lengths of both edges. If opposite sides of the quad have different
/// directions, it includes a contribution of the tangent plane, so that linear functions are
/// preserved.
Rgb find_twist(const Mesh& mesh, const Wedge& wedge, const Slopes<Rgb>& slopes,
               const Slopes<Slopes<Rgb>>& bend);

}  // namespace radiosity

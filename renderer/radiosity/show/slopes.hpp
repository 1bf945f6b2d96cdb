#pragma once
// How the illumination changes around every vertex: the tangent planes there (thesis, 3.1.4.1), and
// the mixed derivatives that Eq 3.4 needs and tangent planes do not give. For both, the patches
// around every vertex, and where a surface ends.

#include <optional>

#include "renderer/radiosity/mesh/mesh.hpp"

namespace radiosity {

/// A patch's corner, as the vertex there sees it; one that is two corners of the patch has one, for
/// both. An edge that a second patch at the vertex shares is an inner one, any other a border.
struct Wedge {
  std::uint32_t patch = 0;
  std::uint32_t corner = 0;          ///< 0..3, the first of the vertex's
  std::uint32_t next = 0, prev = 0;  ///< vertices at the other ends of the corner's edges
  bool next_inner = false, prev_inner = false;
  double trust = 1;  ///< weight of its corners in slopes: see find_trust
};

enum class Place : std::uint8_t {
  inner,     ///< wholly surrounded by patches
  straight,  ///< on a border that passes straight through
  corner     ///< where a border turns, or several meet; also a vertex without patches
};

struct Fans {
  std::vector<Wedge> wedges;         ///< by vertex, and for each by patch
  std::vector<std::uint32_t> first;  ///< index of each vertex's first wedge; one more than vertices
  std::vector<Place> places;         ///< by vertex
  std::vector<std::uint32_t> twins;  ///< by vertex, the next of those that creases have split from
                                     ///< the same one, in a ring: itself if there is no other

  std::span<const Wedge> at(std::size_t vertex) const {
    return std::span(wedges).subspan(first[vertex], first[vertex + 1] - first[vertex]);
  }
};

Fans make_fans(const Mesh& mesh);
/// Fans::twins.
std::vector<std::uint32_t> find_twins(const Mesh& mesh);

/// Calls f with a vertex and each of its twins.
template <class F>
void for_twins(std::span<const std::uint32_t> twins, std::uint32_t vertex, const F& f) {
  std::uint32_t v = vertex;
  do {
    f(v);
    v = twins[v];
  } while (v != vertex);
}

/// The way to a neighbour, laid in the tangent plane of a vertex at its full length.
Vec unfold(const Vertex& vertex, const Vec& to);

/// The change of a quantity for a step along x, y and z. For an illumination B with the normal N_i
/// (figure 3.4) where the surface has N_g it is N_g - N_i, with N_i scaled to N_i . N_g = 1.
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

/// The change for a step d, laid in the vertex's tangent plane: Eq 3.5 times |d|. It contains the
/// half-space rule, Eq 3.6 and 3.7: these slopes are n = (N_i x N_g) x N_g, for N_i as above, and
/// n . d has the wanted sign and, if d is as long as its patch's edge, the wanted size.
template <class T>
T along(const Slopes<T>& slopes, const Vec& d) {
  return d.x * slopes.x + d.y * slopes.y + d.z * slopes.z;
}

/// The mean of the planes in which a vertex's patches lie. It is taken over normals scaled to
/// N_i . N_g = 1, not over unit ones: slopes then average, and the mean does not depend on the unit
/// of B, is linear in it and the same for a colour alone. Weights are sin / (|next| |prev|) (N.
/// Max, "Weights for Computing Vertex Normals from Facet Normals", JGT 4(2), 1999) times the
/// planes' trust. On an even grid it is the arithmetic mean; on any grid of parallel lines it is
/// right up to quadratic functions, if neighbours' steps differ by a factor of 3 at most.
template <class T>
struct MeanPlane {
  Slopes<T> sum;
  double weight = 0;

  /// The plane that changes by `to_next` along `next` and by `to_prev` along `prev`, both across
  /// the unit normal and counter-clockwise.
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

/// The slopes of every vertex, from the illumination of all. On a border there is no mean to take:
/// towards a vertex that knows its slope a parabola through it gives the slope here (below Eq 3.7),
/// towards any other the difference does. Along a border the slope depends on the border's vertices
/// only, so that creases leave no gaps; except where a border with more than a patch inside turns
/// by 8 to 30 degrees, or so far back.
std::vector<Slopes<Rgb>> find_slopes(const Mesh& mesh, const Fans& fans,
                                     std::span<const Rgb> vertices);

/// How the slopes change around a vertex: the mean of the planes through its slopes and its
/// neighbours', as slopes are found from illuminations. Neighbours' slopes are turned with the
/// normal.
Slopes<Slopes<Rgb>> find_bend(const Mesh& mesh, const Fans& fans,
                              std::span<const Slopes<Rgb>> slopes, std::uint32_t vertex);

/// The mixed derivative at a patch's corner along its edges to `next` and `prev`, for a step of
/// both. In an uneven quad, where sides turn from one end to the other, it includes what the
/// tangent plane adds: a linear function stays one.
Rgb find_twist(const Mesh& mesh, const Wedge& wedge, const Slopes<Rgb>& slopes,
               const Slopes<Slopes<Rgb>>& bend);

}  // namespace radiosity

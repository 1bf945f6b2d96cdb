#pragma once
// How the illumination changes around every vertex: its tangent planes (thesis, 3.1.4.1).

#include "renderer/radiosity/show/fans.hpp"

namespace radiosity {

/// The change of a quantity for a step along x, y and z. Of an illumination B with the normal N_i
/// (figure 3.4) where the surface has N_g: N_g - N_i, N_i scaled to N_i . N_g = 1.
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

/// The change for a step d, laid in the vertex's tangent plane: Eq 3.5 times |d|. The half-space
/// rule, Eq 3.6 and 3.7, is in it: n = (N_i x N_g) x N_g, for N_i as above, is these slopes, and
/// n . d has the sign and, if d is as long as its patch's edge, the size that are looked for.
template <class T>
T along(const Slopes<T>& slopes, const Vec& d) {
  return d.x * slopes.x + d.y * slopes.y + d.z * slopes.z;
}

/// The mean of the planes in which a vertex's patches lie. Of the normals scaled to N_i . N_g = 1,
/// not of unit ones: slopes then average, and the mean does not depend on the unit of B, is linear
/// in it and the same for a colour alone. Weighted by sin / (|next| |prev|) (N. Max, "Weights for
/// Computing Vertex Normals from Facet Normals", JGT 4(2), 1999), the arithmetic mean on an even
/// grid; on any grid of parallel lines right up to quadratic functions, if neighbours' steps differ
/// by a factor of 3 at most: planes count by their trust, too.
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

/// Of every vertex, from the illumination of all. On a border there is nothing to take the mean
/// with: towards a vertex that knows its slope a parabola through it gives the slope here (below
/// Eq 3.7), towards any other the difference does. Along a border the slope depends on the border's
/// vertices only, so that creases leave no gaps; but where a border with more than a patch inside
/// turns by 8 to 30 degrees, or so far back.
std::vector<Slopes<Rgb>> find_slopes(const Mesh& mesh, const Fans& fans,
                                     std::span<const Rgb> vertices);

}  // namespace radiosity

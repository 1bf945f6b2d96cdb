#pragma once
// Rooms for the tests of radiosity, and points from which their patches are visible.

#include <fmt/format.h>

#include <functional>

#include "renderer/radiosity/light/form_factor.hpp"
#include "renderer/radiosity/light/solve.hpp"
#include "renderer/trace/intersect.hpp"
#include "tests/renderer/support.hpp"

namespace radiosity::test {

using renderer::NO_OBJECT;
using renderer::Work;
using renderer::test::Random;

inline Rgb grey(double value) { return {value, value, value}; }

/// Adds the quad p, p + a, p + a + b, p + b. Seen from its front, b points to the left of a.
inline Face& add_quad(Room& room, std::uint32_t material, const Vec& p, const Vec& a, const Vec& b,
                      int along = 1, int across = 1) {
  Face face;
  face.corners = {p, p + a, p + a + b, p + b};
  face.material = material;
  face.along = along;
  face.across = across;
  room.faces.push_back(face);
  return room.faces.back();
}

/// The face with its front and back exchanged.
inline Face turn(Face face) {
  std::swap(face.corners[1], face.corners[3]);
  std::swap(face.along, face.across);
  return face;
}

/// Adds the six sides of a box, with n x n patches each: floor, ceiling, and the walls at low x,
/// high x, low y and high y. They face inwards; those of add_block() face outwards.
inline void add_box(Room& room, std::uint32_t material, const Vec& lo, const Vec& hi, int n = 1) {
  const Vec x{hi.x - lo.x, 0, 0}, y{0, hi.y - lo.y, 0}, z{0, 0, hi.z - lo.z};
  add_quad(room, material, lo, x, y, n, n);
  add_quad(room, material, lo + z, y, x, n, n);
  add_quad(room, material, lo, y, z, n, n);
  add_quad(room, material, lo + x, z, y, n, n);
  add_quad(room, material, lo, z, x, n, n);
  add_quad(room, material, lo + y, x, z, n, n);
}
inline void add_block(Room& room, std::uint32_t material, const Vec& lo, const Vec& hi, int n = 1) {
  const auto first = static_cast<std::ptrdiff_t>(room.faces.size());
  add_box(room, material, lo, hi, n);
  for (auto face = room.faces.begin() + first; face != room.faces.end(); ++face)
    *face = turn(*face);
}

/// A regular polygon around an axis. Its front faces in the direction of the axis.
inline std::vector<Vec> make_ring(const Vec& centre, const Vec& axis, double radius, int corners) {
  const auto [u, v] = renderer::test::make_plane(axis);
  std::vector<Vec> ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    ring.push_back(centre + radius * std::cos(angle) * u + radius * std::sin(angle) * v);
  }
  return ring;
}

/// A box of random shape in which a block stands. Above the block, there are two-sided polygons in
/// the air. Everything has material 0. Walls and blocks have n x n patches per side.
inline Room make_furnished(Random& random, int polygons, int n) {
  Room room;
  room.materials = {{"wall", grey(0.5), grey(1)}};
  const Vec size{random.range(2, 4), random.range(2, 4), random.range(2, 3)};
  add_box(room, 0, {0, 0, 0}, size, n);
  const Vec corner{random.range(0.2, 0.5), random.range(0.2, 0.5), 0.1};
  add_block(room, 0, corner, corner + Vec{random.range(0.3, 1), random.range(0.3, 1), 0.6}, n);
  for (int i = 0; i < polygons; ++i) {
    Face face;
    const Vec centre{random.range(0.5, size.x - 0.5), random.range(0.5, size.y - 0.5),
                     1.15 + 0.5 * i / polygons};
    const Vec axis = normalize(Vec{random.range(-0.2, 0.2), random.range(-0.2, 0.2), 1});
    face.corners = make_ring(centre, axis, random.range(0.2, 0.4), 3 + random.below(4));
    face.two_sided = true;
    room.faces.push_back(face);
  }
  return room;
}

inline SolveParams make_params(double tolerance, const FactorParams& factor = {}) {
  SolveParams params;
  params.factor = factor;
  params.tolerance = tolerance;
  return params;
}

/// A vertex that lies on no object.
inline Vertex make_point(const Vec& at, const Vec& normal) {
  return {at, at, normal, 0, NO_OBJECT};
}

/// The mean of f(point) over n x n points of a patch.
double eval_mean(const Mesh&, const Patch& patch, int n, const auto& f) {
  const Quad quad(patch);
  double total = 0, area = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double s = (i + 0.5) / n, t = (j + 0.5) / n, share = quad.eval_density(s, t);
      const Vec at = quad.eval(s, t);
      total += share * f(Vertex{at, at, patch.normal, patch.material, patch.object});
      area += share;
    }
  return total / area;
}

/// The form factor of eval_factor(), plus that via mirrors. Each colour is multiplied by the
/// reflectance of the mirrors.
inline Rgb eval_factors(const Eye& eye, const Vertex& vertex, const Patch& patch, Work& work) {
  return eval_light(eye, vertex, {patch, Glow(grey(1))}, work);
}

inline double sum_factors(const Eye& eye, const Vertex& vertex, const auto& holds) {
  Work work;
  double total = 0;
  for (const Patch& patch : eye.mesh.patches)
    if (holds(patch)) total += eval_factor(eye, vertex, patch, work);
  return total;
}
inline double sum_factors(const Eye& eye, const Vertex& vertex) {
  return sum_factors(eye, vertex, [](const Patch&) { return true; });
}

}  // namespace radiosity::test

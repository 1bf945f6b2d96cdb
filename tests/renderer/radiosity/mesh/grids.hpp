#pragma once
// Grids of patches in space, and illuminations on them, for tests of the reconstruction.

#include <functional>

#include "renderer/radiosity/mesh/divide.hpp"
#include "renderer/radiosity/show/reconstruct.hpp"
#include "tests/renderer/support.hpp"

namespace radiosity::grids {

using renderer::test::Random;

/// Parameters for bicubic surfaces that are not limited to the range of the values around them.

inline constexpr ReconstructionParams make_unlimited(Twist twist) {
  return {Reconstruction::bicubic, twist, false};
}
inline constexpr ReconstructionParams BICUBIC = make_unlimited(Twist::estimated),
                                      BILINEAR{Reconstruction::bilinear, Twist::zero};

inline Rgb grey(double value) { return {value, value, value}; }

inline void add_patch(Mesh& mesh, const std::array<std::uint32_t, 4>& corners) {
  Patch patch;
  patch.corners = corners;
  std::array<Vec, 4> at;
  for (std::size_t k = 0; k < 4; ++k) {
    at[k] = mesh.vertices[corners[k]].at;
    patch.centre += 0.25 * at[k];
  }
  const Vec twice = cross(at[2] - at[0], at[3] - at[1]);
  patch.area = length(twice) / 2;
  patch.normal = normalize(twice);
  mesh.patches.push_back(patch);
}

/// Maps the parameters u and v of two grid lines to the vertex where they meet.
using Surface = std::function<Vertex(double u, double v)>;

/// Makes a patch between any two neighbouring lines u and v. With `turns`, each patch begins at a
/// random corner.
inline Mesh make_grid(const std::vector<double>& u, const std::vector<double>& v,
                      const Surface& surface, Random* turns = nullptr) {
  Mesh mesh;
  for (const double b : v)
    for (const double a : u) mesh.vertices.push_back(surface(a, b));
  const auto row = static_cast<std::uint32_t>(u.size());
  for (std::uint32_t j = 0; j + 1 < v.size(); ++j)
    for (std::uint32_t i = 0; i + 1 < row; ++i) {
      const std::uint32_t at = j * row + i;
      std::array<std::uint32_t, 4> corners{at, at + 1, at + row + 1, at + row};
      if (turns) std::rotate(corners.begin(), corners.begin() + turns->below(4), corners.end());
      add_patch(mesh, corners);
    }
  return mesh;
}

/// Makes the positions of lines from 0 to 1. All steps are equal; with `uneven`, they are random
/// and differ by a factor of at most three.
inline std::vector<double> make_lines(int patches, Random* uneven = nullptr) {
  std::vector<double> lines{0};
  for (int i = 0; i < patches; ++i)
    lines.push_back(lines.back() + (uneven ? uneven->range(1, 3) : 1));
  for (double& line : lines) line /= lines.back();
  return lines;
}

/// A plane with axes u and v of any length. They are at right angles only if `square` is true.
inline Surface make_plane(Random& random, bool square = false) {
  const Vec normal = random.direction(), from = random.point(3);
  const auto [a, b] = renderer::test::make_plane(normal);
  const Vec u = square ? a : random.range(0.5, 3) * a;
  const Vec v = square ? b : random.range(0.5, 3) * b + random.range(-0.4, 0.4) * a;
  return [=](double s, double t) {
    const Vec at = from + s * u + t * v;
    return Vertex{at, at, normal, 0, 0};
  };
}

inline std::vector<Rgb> make_colours(Random& random, std::size_t count) {
  std::vector<Rgb> colours;
  for (std::size_t i = 0; i < count; ++i) colours.push_back(Rgb{9, 9, 9} + random.colour());
  return colours;
}

/// The values of a function at the positions of the mesh's vertices.
template <class F>
std::vector<Rgb> take(const Mesh& mesh, const F& function) {
  std::vector<Rgb> values;
  for (const Vertex& vertex : mesh.vertices) values.push_back(function(vertex.at));
  return values;
}

inline Vec find_point(const Mesh& mesh, std::uint32_t patch, double s, double t) {
  std::array<Vec, 4> at;
  for (std::size_t k = 0; k < 4; ++k) at[k] = mesh.vertices[mesh.patches[patch].corners[k]].at;
  return eval_bilinear(at, s, t);
}

inline double eval_distance(const Rgb& a, const Rgb& b) {
  return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

/// The largest deviation of the illumination from a function, at n x n points of every patch for
/// which `counts` is true.
template <class F>
double find_error(const Mesh& mesh, const Illumination& illumination, const F& function,
                  const std::function<bool(const Patch&)>& counts = {}, int n = 5) {
  double error = 0;
  for (std::uint32_t p = 0; p < mesh.patches.size(); ++p) {
    if (counts && !counts(mesh.patches[p])) continue;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const double s = double(i) / (n - 1), t = double(j) / (n - 1);
        error = std::max(error, eval_distance(eval_illumination(illumination, p, s, t),
                                              function(find_point(mesh, p, s, t))));
      }
  }
  return error;
}

/// The derivatives of the illumination by s and t, at a point inside the patch.
struct Derivatives {
  Rgb by_s, by_t;
};
inline Derivatives differentiate(const Illumination& illumination, std::uint32_t patch, double s,
                                 double t) {
  const auto at = [&](double a, double b) { return eval_illumination(illumination, patch, a, b); };
  const double h = s < 0.5 ? 1e-4 : -1e-4, k = t < 0.5 ? 1e-4 : -1e-4;
  return {1 / (2 * h) * (4.0 * at(s + h, t) + -3.0 * at(s, t) + -1.0 * at(s + 2 * h, t)),
          1 / (2 * k) * (4.0 * at(s, t + k) + -3.0 * at(s, t) + -1.0 * at(s, t + 2 * k))};
}

/// The change of the illumination for a unit step along `d`, in a flat patch.
inline Rgb differentiate_along(const Mesh& mesh, const Illumination& illumination,
                               std::uint32_t patch, double s, double t, const Vec& d) {
  const auto [by_s, by_t] = differentiate(illumination, patch, s, t);
  const Vec a = find_point(mesh, patch, 1, t) - find_point(mesh, patch, 0, t);
  const Vec b = find_point(mesh, patch, s, 1) - find_point(mesh, patch, s, 0);
  const Vec n = cross(a, b);
  const double whole = dot(n, n);
  return dot(cross(d, b), n) / whole * by_s + dot(cross(a, d), n) / whole * by_t;
}

}  // namespace radiosity::grids

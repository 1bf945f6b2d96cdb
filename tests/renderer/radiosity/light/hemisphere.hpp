#pragma once
// An independent calculation of form factors, to check eval_factor(). It counts hits of
// cosine-distributed rays from a vertex (N. Malley). Only the intersection of rays is common to
// both.

#include <map>

#include "renderer/trace/intersect.hpp"
#include "tests/renderer/radiosity/support.hpp"

namespace radiosity::test {

/// A side of a face: the number of the face, and true for the front.
using Side = std::pair<std::uint32_t, bool>;

/// The fraction of n x n directions in which each side of a face is hit first. The directions are
/// stratified: one random direction in each stratum. The objects in Mesh::blockers must be numbered
/// like the faces.
inline std::map<Side, double> eval_hemisphere(const Mesh& mesh, const Vertex& vertex, int n,
                                              Random& random) {
  const auto [u, v] = renderer::test::make_plane(vertex.normal);
  std::map<Side, double> shares;
  Work work;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double square = (i + random.unit()) / n;
      const double angle = 2 * std::numbers::pi * (j + random.unit()) / n;
      const double radius = std::sqrt(square);
      renderer::Ray ray;
      ray.origin = vertex.lit;
      ray.direction = radius * std::cos(angle) * u + radius * std::sin(angle) * v +
                      std::sqrt(1 - square) * vertex.normal;
      ray.from = vertex.object;
      const auto hit = intersect(mesh.blockers, ray, renderer::Traversal::exhaustive, work);
      if (hit) shares[{hit->object, !hit->inside}] += 1.0 / n / n;
    }
  return shares;
}

/// The form factors of the sides of all faces, computed by eval_factor().
inline std::map<Side, double> eval_sides(const Eye& eye, const Vertex& vertex, const Room& room) {
  std::map<Side, double> shares;
  Work work;
  for (const Patch& patch : eye.mesh.patches) {
    const bool front = dot(patch.normal, eval_area_normal(room.faces[patch.face].corners)) > 0;
    const double factor = eval_factor(eye, vertex, patch, work);
    if (factor > 0) shares[{patch.face, front}] += factor;
  }
  return shares;
}

}  // namespace radiosity::test

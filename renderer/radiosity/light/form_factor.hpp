#pragma once
// Form factors of a patch to a vertex, by casting rays: J. Wallace, K. Elmquist and E. Haines, "A
// Ray Tracing Algorithm for Progressive Radiosity", SIGGRAPH 1989; thesis, Eq 3.8 and 3.9.

#include <optional>

#include "renderer/radiosity/mesh/mesh.hpp"
#include "renderer/trace/intersect.hpp"

namespace radiosity {

inline constexpr int MOST_REFLECTIONS = 8;

struct FactorParams {
  int samples = 1;       ///< a patch is cut into samples x samples delta areas, 1 to 1024
  double spread = 0.18;  ///< and a delta area in half, along its longer side or both, while it is
                         ///< wider than this share of its distance; > 0
  int halvings = 12;     ///< at most so many times, 0 to 30; 0: delta areas of equal size only
  int reflections = 2;   ///< mirrors that light may meet on its way, 0 to MOST_REFLECTIONS
  double mirror_share = 0.5;  ///< and, where it is seen in mirrors, while it is wider than this
                              ///< share of the least of them, as both are seen; > 0. But never
                              ///< more than if spread were a quarter
  int mirror_pieces = 0;  ///< a mirror is cut into so many pieces along and across; 0: into what
                          ///< each delta area is seen through (mirrors.hpp)
  renderer::Traversal traversal = renderer::Traversal::nearest;
};

/// Throws std::invalid_argument naming the field, what was found and what was expected.
void check(const FactorParams& params);

/// What sees: the rays' way through a mesh's blockers. `access`, where there is one, is told of all
/// that is read.
struct Eye {
  const Mesh& mesh;
  const FactorParams& params;
  renderer::Access* access = nullptr;
};

/// Whether nothing blocks the way from a point on one object to a point on another.
bool sees(const Eye& eye, const Vec& from, std::uint32_t object, const Vec& to, std::uint32_t other,
          renderer::Work& work);

/// The sum of Eq 3.9 times A_2: the share of the vertex's hemisphere, weighted by its cosine, in
/// which the patch is seen, 0..1; B_1 = rho_1 B_2 times it. Without reflections. Adds to `work`.
double eval_factor(const Eye& eye, const Vertex& vertex, const Patch& patch, renderer::Work& work);

/// The same and what arrives by way of mirrors, each colour times the mirrors' reflectance.
Rgb eval_factors(const Eye& eye, const Vertex& vertex, const Patch& patch, renderer::Work& work);

}  // namespace radiosity

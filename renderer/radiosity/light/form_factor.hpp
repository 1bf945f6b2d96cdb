#pragma once
// Form factors of a patch to a vertex, by casting rays: J. Wallace, K. Elmquist and E. Haines, "A
// Ray Tracing Algorithm for Progressive Radiosity", SIGGRAPH 1989; thesis, Eq 3.8 and 3.9.

#include <optional>

#include "renderer/radiosity/mesh/mesh.hpp"
#include "renderer/trace/access.hpp"

namespace radiosity {

inline constexpr int MOST_REFLECTIONS = 8;

/// A patch is cut into delta areas. One that is too wide, `spread` and `mirror_share` say, is
/// halved, along its longer side or both.
struct FactorParams {
  int samples = 1;       ///< delta areas along and across a patch, 1 to 1024
  double spread = 0.18;  ///< widest delta area that is not halved, a share of its distance, > 0
  int halvings = 12;     ///< most halvings of a delta area, 0 to 30; 0: all have equal size
  int reflections = 2;   ///< most mirrors that light may meet on its way, 0 to MOST_REFLECTIONS
  /// Widest delta area that is not halved where it is seen in mirrors, a share of the narrowest of
  /// them as both are seen, > 0; not halved more than if spread were a quarter.
  double mirror_share = 0.5;
  /// Pieces of a mirror along and across, 0 to 10000; 0: a piece for each delta area, through which
  /// that is seen (mirrors.hpp).
  int mirror_pieces = 0;
  renderer::Traversal traversal = renderer::Traversal::nearest;
};

/// BadInput naming the field, what was found and what was expected.
void check(const FactorParams& params);

/// What visibility is found with: the mesh whose blockers rays are cast against. `access`, unless
/// null, is told of all that is read.
struct Eye {
  const Mesh& mesh;
  const FactorParams& params;
  renderer::Access* access = nullptr;
};

/// Whether nothing blocks the way from a point on one object to a point on another.
bool sees(const Eye& eye, const Vec& from, std::uint32_t object, const Vec& to, std::uint32_t other,
          renderer::Work& work);

/// The sum of Eq 3.9 times A_2, without mirrors: the share of the vertex's hemisphere, weighted by
/// its cosine, in which the patch is seen, 0..1; B_1 = rho_1 B_2 times it. Adds to `work`.
double eval_factor(const Eye& eye, const Vertex& vertex, const Patch& patch, renderer::Work& work);

/// eval_factor() and what arrives by way of mirrors, each colour times the mirrors' reflectance.
Rgb eval_factors(const Eye& eye, const Vertex& vertex, const Patch& patch, renderer::Work& work);

}  // namespace radiosity

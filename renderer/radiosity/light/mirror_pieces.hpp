#pragma once
// Mirrors cut into pieces of equal size: Eq 3.17 and 3.18 as they stand.

#include "renderer/radiosity/light/mirror_path.hpp"

namespace radiosity {

struct MirroredPatch {
  const Eye& eye;
  const Vertex& vertex;
  const Patch& patch;
  const Quad& quad;
  const Chain& chain;
};

/// The sum of Eq 3.17 over the patch's delta areas (samples x samples, not halved) and the pieces
/// of the chain's mirrors (FactorParams::mirror_pieces).
double sum_pieces(const MirroredPatch& seen, renderer::Work& work);

}  // namespace radiosity

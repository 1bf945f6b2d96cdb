#pragma once
// Form factors by way of mirrors: thesis, 3.2.2 and 3.2.3.
//
// The light of a delta area reaches a vertex through a piece of the mirror, and of the path's solid
// angles the least counts (Eq 3.17, 3.18). Two ways to cut mirrors:
// - FactorParams::mirror_pieces = n: once and for all, n x n pieces. Where a piece, as the vertex
//   sees it, is smaller than the delta area, every piece in whose centre the delta area is seen
//   gives its share h; where it is larger, the one piece that shows the delta area's centre gives
//   all (h = 1). Of a chain's mirrors each one's pieces count where they are the least: counted
//   over the first's alone, light that a farther mirror's pieces, as large but seen smaller, let
//   through would be lost. (The thesis instead lets every path from a delta area over a piece's
//   centre light the corners of the patch that it ends on, divided by the patches that share them.
//   The sum of its h is then A_R / A_E times the square of d_ES / d_SR, not 1: only where these
//   happen to agree is it the light of the mirrored room.)
// - 0, what the thesis leaves open (3.2.5): by distance and solid angle, anew for each vertex and
//   delta area. A piece is what the vertex sees the delta area through: omega_S = omega, h = 1;
//   delta areas are halved until their piece is small on the mirror (mirror_share). No light is
//   lost or doubled, and the illumination has no steps (figure 3.19).

#include "renderer/radiosity/light/form_factor.hpp"

namespace radiosity {

/// What the patch sends to the vertex over 1 to FactorParams::reflections mirrors, each chain once;
/// for each colour times the reflectance of the chain's mirrors.
Rgb eval_mirrored_factor(const Eye& eye, const Vertex& vertex, const Patch& patch,
                         renderer::Work& work);

}  // namespace radiosity

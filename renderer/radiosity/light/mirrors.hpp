#pragma once
// Form factors by way of mirrors: thesis, 3.2.2 and 3.2.3.
//
// The light of a delta area reaches a vertex through a piece of the mirror, and the least of the
// path's solid angles counts (Eq 3.17, 3.18). There are two ways to cut mirrors:
// - FactorParams::mirror_pieces = n cuts each into n x n pieces. Where a piece, as the vertex sees
//   it, is smaller than the delta area, every piece through whose centre the delta area is seen
//   gives its share h; where it is larger, the one piece that shows the delta area's centre gives
//   all (h = 1). The pieces of each mirror of a chain count where they are the least: if only the
//   first mirror's did, light would be lost that a farther mirror's pieces, as large but seen
//   smaller, let through. (The thesis instead lets every path from a delta area over a piece's
//   centre light the corners of the patch that it ends on, divided by the patches that share them.
//   The sum of its h is then A_R / A_E times the square of d_ES / d_SR, not 1: only where these
//   happen to agree is it the light of the mirrored room.)
// - mirror_pieces = 0 cuts by distance and solid angle, anew for each vertex and delta area, which
//   the thesis leaves open (3.2.5). The vertex sees the delta area through the whole piece, so
//   omega_S = omega and h = 1; delta areas are halved until their piece is small on the mirror
//   (mirror_share). No light is lost or doubled, and the illumination has no steps (figure 3.19).

#include "renderer/radiosity/light/form_factor.hpp"
#include "renderer/radiosity/light/terms.hpp"

namespace radiosity {

/// The light that a patch sends to the vertex over 1 to FactorParams::reflections mirrors, each
/// chain once; for each colour times the reflectance of the chain's mirrors.
Rgb eval_mirrored_light(const Eye& eye, const Vertex& vertex, const Sender& sender,
                        renderer::Work& work);

/// Adds the terms of that light, whatever the sender's glow, and their chains.
void find_mirrored_terms(const Eye& eye, const Vertex& vertex, const Sender& sender, Terms& kept,
                         renderer::Work& work);

}  // namespace radiosity

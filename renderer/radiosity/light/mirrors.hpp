#pragma once
// Form factors over mirrors (thesis, 3.2.2 and 3.2.3).
//
// The light of a delta area reaches a vertex through a piece of each mirror. The least of the solid
// angles on the path counts (Eq 3.17, 3.18). There are two ways to cut mirrors into pieces:
// - FactorParams::mirror_pieces = n cuts each mirror into n x n pieces. Pieces that appear smaller
//   than the delta area give their share h each, if they show the delta area through their centres.
//   A larger piece that shows the delta area's centre gives all (h = 1). On a chain, the pieces of
//   each mirror count where they are the smallest. If only those of the first mirror counted, light
//   would be lost where a farther mirror's pieces appear smaller.
//   The thesis differs: every path from a delta area over a piece's centre lights the corners of
//   the patch at its end, divided by the patches that share them. The sum of h is then A_R / A_E
//   times the square of d_ES / d_SR. This equals the light of the mirrored room only if it is 1.
// - mirror_pieces = 0 cuts by distance and solid angle, separately for each vertex and delta area,
//   which the thesis leaves open (3.2.5). The vertex sees the delta area through the whole piece,
//   so that omega_S = omega and h = 1. Delta areas are halved until their piece is small on the
//   mirror (mirror_share). No light is lost or doubled, and the illumination has no steps
//   (figure 3.19).

#include "renderer/radiosity/light/form_factor.hpp"
#include "renderer/radiosity/light/terms.hpp"

namespace radiosity {

/// The light from a patch that arrives at the vertex over 1 to FactorParams::reflections mirrors,
/// summed over all chains. Each colour is multiplied by the reflectance of the chain's mirrors.
Rgb eval_mirrored_light(const Eye& eye, const Vertex& vertex, const Sender& sender,
                        renderer::Work& work);

/// Adds the terms of the light that eval_mirrored_light() sums, with their chains. Terms do not
/// depend on the patch's radiosity.
void find_mirrored_terms(const Eye& eye, const Vertex& vertex, const Sender& sender, Terms& kept,
                         renderer::Work& work);

}  // namespace radiosity

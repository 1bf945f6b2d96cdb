#pragma once
// Form factors over mirrors (thesis, 3.2.2 and 3.2.3).
//
// The light of a delta area reaches a vertex through a piece of each mirror on its path. Of these
// pieces, the one with the least solid angle determines the light (Eq 3.17, 3.18). There are two
// ways to cut mirrors into pieces:
// - FactorParams::mirror_pieces = n cuts each mirror into n x n pieces. A piece that appears
//   smaller than the delta area contributes a share h of its light, if the delta area is visible
//   through the centre of the piece. A larger piece contributes all of it (h = 1), if the centre of
//   the delta area is visible through the piece. With several mirrors, the pieces of the mirror
//   count that appear smallest. If always those of the first mirror counted, light would be lost
//   where a farther mirror's pieces appear smaller. The thesis differs: every path from a delta
//   area over a piece's centre lights the corners of the patch where it ends, divided by the number
//   of patches that share a corner. The shares h then add up to A_R / A_E times the square of d_ES
//   / d_SR. The result equals the light of the mirrored room only if this sum is 1.
// - mirror_pieces = 0 cuts mirrors by distance and solid angle (an open problem in the thesis,
//   3.2.5), separately for each vertex and delta area. A piece is as large as the delta area
//   appears in it, so that omega_S = omega and h = 1. Delta areas are halved until their pieces are
//   small parts of the mirror (mirror_share). No light is lost or doubled, and the illumination has
//   no steps (figure 3.19).

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

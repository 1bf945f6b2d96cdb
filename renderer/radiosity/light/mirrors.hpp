#pragma once
// Form factors for light that arrives via mirrors (thesis, 3.2.2 and 3.2.3).
//
// The light of a delta area reaches a vertex through one piece of each mirror on its path. The
// piece with the smallest solid angle determines the light (Eq 3.17, 3.18). There are two ways to
// divide mirrors into pieces:
// - FactorParams::mirror_pieces = n divides each mirror into n x n pieces. A piece that appears
//   smaller than the delta area contributes a fraction h of the light, if the delta area is visible
//   through the centre of the piece. A larger piece contributes all of it (h = 1), if the centre of
//   the delta area is visible through the piece. With several mirrors, the mirror whose pieces
//   appear smallest counts. If the first mirror always counted, light would be lost where the
//   pieces of a farther mirror appear smaller. The thesis differs: every path from a delta area
//   through the centre of a piece lights the corners of the patch where it ends, divided by the
//   number of patches that share a corner. The fractions h then add up to A_R / A_E times the
//   square of d_ES / d_SR. The result is correct only if this sum is 1.
// - mirror_pieces = 0 divides mirrors by distance and solid angle, separately for each vertex and
//   delta area. (The thesis names this as an open problem, 3.2.5.) A piece is as large as the delta
//   area appears in the mirror, so that omega_S = omega and h = 1. Delta areas are halved until
//   their pieces are small parts of the mirror (mirror_share). No light is lost or doubled, and the
//   illumination has no steps (figure 3.19).

#include "renderer/radiosity/light/form_factor.hpp"
#include "renderer/radiosity/light/terms.hpp"

namespace radiosity {

/// The light from a patch that arrives at the vertex via 1 to FactorParams::reflections mirrors,
/// summed over all chains of mirrors. Each colour is multiplied by the reflectances of the chain's
/// mirrors.
Rgb eval_mirrored_light(const Eye& eye, const Vertex& vertex, const Sender& sender,
                        renderer::Work& work);

/// Appends to `kept` the terms of the sum that eval_mirrored_light() computes, together with their
/// chains of mirrors. The terms do not depend on the patch's radiosity.
void find_mirrored_terms(const Eye& eye, const Vertex& vertex, const Sender& sender, Terms& kept,
                         renderer::Work& work);

}  // namespace radiosity

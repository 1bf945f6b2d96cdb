#pragma once
// Form factors over mirrors: thesis, 3.2.2 and 3.2.3.
//
// The light of a delta area reaches a vertex through a piece of the mirror. The least of the path's
// solid angles counts (Eq 3.17, 3.18). There are two ways to cut mirrors:
// - FactorParams::mirror_pieces = n cuts each into n x n pieces. Pieces that the vertex sees
// smaller
//   than the delta area each give their share h, if they show it through their centres. A larger
//   piece that shows the delta area's centre gives all (h = 1). On a chain, the pieces of each
//   mirror count where they are the least. With pieces of the first mirror only, light through the
//   pieces of a farther mirror, as large but seen smaller, would be lost. In the thesis, instead,
//   every path from a delta area over a piece's centre lights the corners of the patch at its end,
//   divided by the patches that share them. The sum of its h is then A_R / A_E times the square of
//   d_ES / d_SR, not 1. It equals the light of the mirrored room only if these agree.
// - mirror_pieces = 0 cuts by distance and solid angle, separately for each vertex and delta area,
//   which the thesis leaves open (3.2.5). The vertex sees the delta area through the whole piece,
//   so that omega_S = omega and h = 1. Delta areas are halved until their piece is small on the
//   mirror (mirror_share). No light is lost or doubled, and the illumination has no steps
//   (figure 3.19).

#include "renderer/radiosity/light/form_factor.hpp"
#include "renderer/radiosity/light/terms.hpp"

namespace radiosity {

/// The light from a patch at the vertex over 1 to FactorParams::reflections mirrors, summed over
/// all chains. Each colour is multiplied by the reflectance of a chain's mirrors.
Rgb eval_mirrored_light(const Eye& eye, const Vertex& vertex, const Sender& sender,
                        renderer::Work& work);

/// Adds the terms of that light, independent of the sender's glow, and their chains.
void find_mirrored_terms(const Eye& eye, const Vertex& vertex, const Sender& sender, Terms& kept,
                         renderer::Work& work);

}  // namespace radiosity

#pragma once
// Where penumbrae begin and end: D. Lischinski, F. Tampieri and D. Greenberg, "Discontinuity
// Meshing for Accurate Radiosity", IEEE CG&A 12(6), 1992; left open by the thesis (3.1.4.2, 6.2).

#include "renderer/radiosity/room.hpp"

namespace radiosity {

/// The straight borders of penumbrae on every diffuse face, of every emitting face behind every
/// other face: where the planes through an edge of one and a corner of the other cut the face.
/// Borders that another face hides from the light are left out; equal ones are given once.
std::vector<Crease> find_creases(const Room& room);

}  // namespace radiosity

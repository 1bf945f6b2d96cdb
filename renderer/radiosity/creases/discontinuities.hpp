#pragma once
// Where penumbrae begin and end: D. Lischinski, F. Tampieri and D. Greenberg, "Discontinuity
// Meshing for Accurate Radiosity", IEEE CG&A 12(6), 1992; left open by the thesis (3.1.4.2, 6.2).

#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// On every diffuse face that reflects, for every emitting face: what add_shadow_creases finds for
/// every other face that can be between, and add_horizon_crease. These are the borders of
/// penumbrae, and within them where a face hides all that it can; not every change of slope. Light
/// by way of mirrors is not followed. Creases on one line are joined; those shorter than 0.001 of
/// their face are left out. In the order of the faces they lie on; the room must pass check(). Of n
/// faces, e of them emitting, some e n^2 pairs are looked at, and all n for each crease.
std::vector<Crease> find_creases(const Room& room);

}  // namespace radiosity

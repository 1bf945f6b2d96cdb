#pragma once
// Discontinuity lines of penumbrae: D. Lischinski, F. Tampieri and D. Greenberg, "Discontinuity
// Meshing for Accurate Radiosity", IEEE CG&A 12(6), 1992; left open by the thesis (3.1.4.2, 6.2).

#include "base/fields.hpp"
#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// Finds the creases of every emitting face on every reflecting diffuse face. Borders of penumbrae
/// and umbrae are its intersections with the light's own plane and with critical planes (edge and
/// corner) of the light and another face between, as far as these touch both (G. Drettakis and E.
/// Fiume, "A Fast Shadow Algorithm for Area Light Sources Using Backprojection", SIGGRAPH 1994).
/// Creases within a penumbra are lines behind an edge at which another corner of the light becomes
/// visible; other changes of form are not all found. Light by way of mirrors is ignored. Creases on
/// one line are joined; those shorter than 0.001 of their face are dropped. The order is by face;
/// on a face first all borders, those of its strongest light first, then the lines within in the
/// same order. The room must pass check(). With n faces, e of them emitting, it examines some e n^2
/// pairs, and all n faces for each crease.
std::vector<Crease> find_creases(const Room& room);

/// The creases that a room's mesh keeps.
enum class Creases : std::uint8_t {
  file,   ///< those in the room's file
  found,  ///< also those of find_creases(); patches near lights are finer, too
  none
};

/// The field "creases".
base::Field<Creases> creases_field();

/// Sets the room's creases, and Room::fine_near_lights and Room::fine_shadows accordingly.
void choose_creases(Room& room, Creases creases);

}  // namespace radiosity

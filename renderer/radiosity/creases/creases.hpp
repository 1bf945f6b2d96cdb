#pragma once
// Discontinuity lines of penumbrae (D. Lischinski, F. Tampieri and D. Greenberg, "Discontinuity
// Meshing for Accurate Radiosity", IEEE CG&A 12(6), 1992). The thesis leaves them open (3.1.4.2,
// 6.2).

#include "base/fields.hpp"
#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// Finds the creases of every emitting face on every diffuse face. The room must pass check().
///
/// Borders of penumbrae and umbrae are intersections with two kinds of planes, as far as these
/// touch the light and an occluder: the light's own plane, and critical planes through an edge and
/// a corner (G. Drettakis and E. Fiume, "A Fast Shadow Algorithm for Area Light Sources Using
/// Backprojection", SIGGRAPH 1994). Creases within a penumbra are lines at which, behind an edge,
/// another corner of the light becomes visible. Not all other discontinuities are found. Light
/// reflected by mirrors is ignored.
///
/// Creases on one line are joined; those shorter than 0.001 of their face are dropped. They are
/// sorted by face. On a face, borders come first, those of its strongest light before others, then
/// lines within penumbrae in the same order. With n faces, e of them emitting, some e n^2 pairs are
/// examined, and all n faces for each crease.
std::vector<Crease> find_creases(const Room& room);

/// The creases that the mesh of a room contains.
enum class Creases : std::uint8_t {
  file,   ///< only creases listed in the room's file
  found,  ///< listed creases and those of find_creases(); patches near lights are finer too
  none
};

/// Makes the field "creases".
base::Field<Creases> creases_field();

/// Sets the creases of a room, and Room::fine_near_lights and Room::fine_shadows accordingly.
void choose_creases(Room& room, Creases creases);

}  // namespace radiosity

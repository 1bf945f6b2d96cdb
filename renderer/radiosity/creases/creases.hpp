#pragma once
// Discontinuity lines of penumbrae (D. Lischinski, F. Tampieri and D. Greenberg, "Discontinuity
// Meshing for Accurate Radiosity", IEEE CG&A 12(6), 1992). The thesis does not treat these lines
// (3.1.4.2, 6.2).

#include "base/fields.hpp"
#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// Finds the creases that every emitting face causes on every diffuse face. The room must pass
/// check().
///
/// Borders of penumbrae and umbrae are intersections of a face with two kinds of planes: the
/// light's own plane, and critical planes through an edge of the light and a corner of an occluder,
/// or the reverse (G. Drettakis and E. Fiume, "A Fast Shadow Algorithm for Area Light Sources Using
/// Backprojection", SIGGRAPH 1994). Creases within a penumbra are lines at which one more corner of
/// the light becomes visible behind an edge. Some other discontinuities are not found. Light
/// reflected by mirrors is ignored.
///
/// Creases on one line are joined; those shorter than 0.001 of their face are dropped. They are
/// sorted by face. The creases of a face begin with the borders, sorted by the strength of their
/// lights; then come the lines within penumbrae, in the same order. For n faces of which e emit,
/// about e n^2 pairs of faces are examined, and for each crease all n faces again.
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

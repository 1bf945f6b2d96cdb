#pragma once
// Creases: lines on a face at which the illumination or its derivatives jump, such as borders of
// penumbrae (D. Lischinski, F. Tampieri and D. Greenberg, "Discontinuity Meshing for Accurate
// Radiosity", IEEE CG&A 12(6), 1992). The thesis does not treat them (3.1.4.2, 6.2).

#include "base/fields.hpp"
#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// Finds the creases that emitting faces cause on diffuse faces. The room must pass check().
///
/// The borders of penumbrae and umbrae are intersections of a face with planes of two kinds: the
/// plane of a light, and critical planes. A critical plane passes through an edge of the light and
/// a corner of an occluder, or through a corner of the light and an edge of the occluder (G.
/// Drettakis and E. Fiume, "A Fast Shadow Algorithm for Area Light Sources Using Backprojection",
/// SIGGRAPH 1994). Further creases lie within a penumbra, where one more corner of the light
/// becomes visible behind an edge. Some other discontinuities are not found. Light reflected by
/// mirrors is ignored.
///
/// Creases on one line are joined. Creases shorter than 0.001 of their face's size are dropped. The
/// result is sorted by face. For each face, the borders of shadows come first, in descending order
/// of the strength of their lights. The lines within penumbrae follow in the same order. For n
/// faces, e of which emit light, about e n^2 pairs of faces are examined, and for each crease all n
/// faces again.
std::vector<Crease> find_creases(const Room& room);

/// The creases along which the mesh of a room is divided.
enum class Creases : std::uint8_t {
  file,   ///< only creases listed in the room's file
  found,  ///< listed creases and those of find_creases(); also finer patches near lights
  none
};

/// Makes the field "creases".
base::Field<Creases> creases_field();

/// Sets the creases of a room according to `creases`. Also sets Room::fine_near_lights and
/// Room::fine_shadows.
void choose_creases(Room& room, Creases creases);

}  // namespace radiosity

#pragma once
// Where penumbrae begin, end and change their form: D. Lischinski, F. Tampieri and D. Greenberg,
// "Discontinuity Meshing for Accurate Radiosity", IEEE CG&A 12(6), 1992; left open by the thesis
// (3.1.4.2, 6.2).

#include "base/fields.hpp"
#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// The creases on every diffuse face that reflects, for every emitting face: where the critical
/// planes (edge and corner) of the light and of every other face that can be between meet it, as
/// far as they touch both (G. Drettakis and E. Fiume, "A Fast Shadow Algorithm for Area Light
/// Sources Using Backprojection", SIGGRAPH 1994), and where the light's own plane does: the borders
/// of penumbrae and of umbrae. And within a penumbra the lines at which, past an edge, another
/// corner of the light comes into sight; not every such change of form. Light by way of mirrors is
/// not followed. Creases on one line are joined; those shorter than 0.001 of their face are left
/// out. They come in the order of the faces they lie on; of one face, first all borders, those of
/// the light that is strongest on it before others, then the lines within in the same order. The
/// room must pass check(). With n faces, e of them emitting, some e n^2 pairs are looked at, and
/// all n for each crease.
std::vector<Crease> find_creases(const Room& room);

/// Which creases the mesh of a room keeps.
enum class Creases : std::uint8_t {
  file,   ///< those that the room's file marks
  found,  ///< those and the ones that find_creases() finds; patches near lights are finer, too
  none
};

/// The field "creases".
base::Field<Creases> creases_field();

/// The room's creases become the chosen ones, and Room::fine_near_lights and
/// Room::fine_shadows what belongs to them.
void choose_creases(Room& room, Creases creases);

}  // namespace radiosity

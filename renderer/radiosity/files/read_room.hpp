#pragma once
// Rooms in tlab's own text format: one statement a line, `#` starts a comment, materials before
// what uses them.
//
//   material NAME reflect R G B [emit R G B]
//   mirror NAME reflect R G B
//   quad MATERIAL  x y z  x y z  x y z  x y z  [divide N M] [two-sided]
//   polygon MATERIAL  x y z ... [divide N] [two-sided]
//   box MATERIAL  x y z  x y z  [divide N] [inside]      six quads, least corner first; their
//                                                        fronts outside, or inside
//   crease x y z  x y z
//   view from x y z at x y z up x y z angle DEGREES size W H      required, once
//
// Divisions are Face::along and across.

#include <istream>
#include <string>

#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// BadInput "name:line: found ..., expected ...". The view has its image plane.
Room read_room(std::istream& in, const std::string& name);

}  // namespace radiosity

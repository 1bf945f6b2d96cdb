#pragma once
// Rooms from files of three formats, told apart by the ending of the file's name.
//
// .room is tlab's own text format: one statement a line, `#` starts a comment, materials before
// what uses them. Divisions are Face::along and across.
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
// .nff (renderer/files/nff.hpp): faces are p and pp. The surface f before them is diffuse and
// reflects kd times its colour, or where ks is 1 and kd 0 it is a mirror that reflects all. Its
// highlights are passed over, as are l and b. `# emit R G B` after an f: the faces from there on
// emit. Spheres and cones, which are not flat, and T above 0 are errors.
//
// .obj, with its MTL files (renderer/files/obj.hpp): every face is one patch before
// MeshParams::refine, and its texture coordinates and pictures are passed over. Kd is the
// reflectance and Ke the emission; `illum 3`, which asks for mirror images by ray tracing, makes
// the material a mirror: it reflects Ks, and its Kd is passed over. Lights and the background are,
// too.

#include <string>
#include <string_view>

#include "renderer/files/left_out.hpp"
#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// Reads a file. BadInput "file:line: found ..., expected ..."; the room has passed check(), and
/// its view has its image plane. A room that is a thousand times as far from the origin as it is
/// wide has been moved there, so that what is computed in it is as exact as its coordinates.
Room load_room(const std::string& path);

/// Reads a text in the same way, but leaves the room where it is; `name` stands for the path. What
/// a scene has and rooms have not, such as lights, is counted if that is asked for.
Room read_room(std::string_view text, const std::string& name,
               renderer::LeftOut* left_out = nullptr);

}  // namespace radiosity

#pragma once
// Rooms from files.

#include <istream>
#include <string>

#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// Reads a file, by its ending: .room (ours, see read_room), .nff or .obj. BadInput "file:line:
/// found ..., expected ..."; the room has passed check().
Room load_room(const std::string& path);

/// The text format: one statement a line, `#` starts a comment, materials before what uses them.
///   material NAME reflect R G B [emit R G B]
///   mirror NAME reflect R G B
///   quad MATERIAL  x y z  x y z  x y z  x y z  [divide N M] [two-sided]
///   polygon MATERIAL  x y z ... [divide N] [two-sided]
///   box MATERIAL  x y z  x y z  [divide N] [inside]      six quads, least corner first; their
///                                                        fronts outside, or inside
///   crease x y z  x y z
///   view from x y z at x y z up x y z angle DEGREES size W H      required, once
/// Divisions are Face::along and across. The view has its image plane.
Room read_room(std::istream& in, const std::string& name);

/// NFF (renderer/nff.hpp): p and pp, of the surface f before them: diffuse, reflecting kd times its
/// colour, or where ks is 1 and kd 0 a mirror that reflects all; its highlights are passed over, as
/// are l and b. `# emit R G B` after an f: its faces from there on emit. BadInput for spheres and
/// cones, which are not flat, and for T above 0.
Room read_nff_room(std::istream& in, const std::string& name);

/// Wavefront OBJ with its MTL (mtl.hpp); normals (vn) where a face has them, every face undivided.
/// v, vn, f, usemtl and mtllib count; vt, g, o and s are passed over, others BadInput. An OBJ has
/// no view: it is looked at from outside, along the diagonal of its bounds from the greatest
/// corner, y upwards.
Room load_obj_room(const std::string& path);

}  // namespace radiosity

#pragma once
// Rooms from files of three formats, distinguished by the file name's ending.
//
// .room is tlab's own text format: one statement a line, `#` starts a comment, and materials come
// before their uses. `divide` sets Face::along and Face::across.
//
//   material NAME reflect R G B [emit R G B]
//   mirror NAME reflect R G B
//   quad MATERIAL  x y z  x y z  x y z  x y z  [divide N M] [two-sided]
//   polygon MATERIAL  x y z ... [divide N] [two-sided]
//   box MATERIAL  x y z  x y z  [divide N] [inside]      six quads, fronts outwards or inwards;
//                                                        least and largest coordinates
//   crease x y z  x y z
//   view from x y z at x y z up x y z angle DEGREES size W H      required, once
//
// .nff (renderer/files/nff.hpp): faces are p and pp. The surface `f` before them is diffuse and
// reflects kd times its colour; with ks = 1 and kd = 0 it is a perfect mirror. Highlights, lights
// (`l`) and background (`b`) are ignored. `# emit R G B` after an `f` makes the following faces
// emit. Spheres and cones, which are not flat, and T above 0 are errors.
//
// .obj, with its MTL files (renderer/files/obj.hpp): every face is one patch before
// MeshParams::refine. A face that is not flat or not convex becomes triangles; normals that are not
// on the side of its front are ignored. Texture coordinates and pictures are ignored. Kd is the
// reflectance and Ke the emission. `illum 3`, which requests mirror images by ray tracing, makes
// the material a mirror that reflects Ks and ignores Kd. Lights and the background are ignored,
// too.

#include <string>
#include <string_view>

#include "renderer/files/text/left_out.hpp"
#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// Loads a room from a file. It has passed check(), and its view has its image plane. A room that
/// is more than 1000 times as far from the origin as it is wide is moved to the origin, so that
/// computations are as exact as its coordinates. `left_out`, if given, counts the parts of a file
/// that cannot be read or that rooms do not have, such as lights. Throws BadInput "file:line: found
/// ..., expected ...".
Room load_room(const std::string& path, renderer::LeftOut* left_out = nullptr);

/// Reads a room from a text, without moving it. `name` replaces the path in errors.
Room read_room(std::string_view text, const std::string& name,
               renderer::LeftOut* left_out = nullptr);

}  // namespace radiosity

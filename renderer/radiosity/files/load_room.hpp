#pragma once
// Loads rooms from files in three formats. The ending of the file's name determines the format.
//
// .room is tlab's own text format: one statement per line, `#` starts a comment, and materials are
// defined before they are used. `divide` sets Face::along and Face::across.
//
//   material NAME reflect R G B [emit R G B]
//   mirror NAME reflect R G B
//   quad MATERIAL  x y z  x y z  x y z  x y z  [divide N M] [two-sided]
//   polygon MATERIAL  x y z ... [divide N] [two-sided]
//   box MATERIAL  x y z  x y z  [divide N] [inside]      corners with the smallest and the largest
//                                                        coordinates; six quads, fronts outwards
//                                                        or, with `inside`, inwards
//   crease x y z  x y z
//   view from x y z at x y z up x y z angle DEGREES size W H      required, once
//
// .nff (renderer/files/nff.hpp): the faces are p and pp. The surface `f` before them is diffuse and
// reflects Kd times its colour. With Ks = 1 and Kd = 0 it is a perfect mirror. Highlights, lights
// (`l`) and background (`b`) are ignored. `# emit R G B` after an `f` makes the following faces
// emit light. Spheres and cones, which are not flat, and T above 0 are errors.
//
// .obj with its MTL files (renderer/files/obj.hpp): every face is one patch before it is divided by
// MeshParams::refine. A face that is not flat or not convex is divided into triangles. Normals that
// are not on the front side of their face are ignored, and so are texture coordinates, pictures,
// lights and the background. Kd is the reflectance, and Ke the emission. `illum 3`, which requests
// mirror images by ray tracing, makes the material a mirror that reflects Ks and ignores Kd.

#include <string>
#include <string_view>

#include "renderer/files/text/left_out.hpp"
#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// Loads a room from a file. The room passes check(), and its view has its image plane. A room that
/// is more than 1000 times as far from the origin as it is wide is moved to the origin, so that the
/// results are as exact as its coordinates. `left_out`, if given, counts the parts of the file that
/// are unreadable or that rooms do not have, such as lights. Throws BadInput "file:line: found ...,
/// expected ...".
Room load_room(const std::string& path, renderer::LeftOut* left_out = nullptr);

/// Reads a room from a text, without moving it. The ending of `name` determines the format; error
/// messages use `name` as the path.
Room read_room(std::string_view text, const std::string& name,
               renderer::LeftOut* left_out = nullptr);

}  // namespace radiosity

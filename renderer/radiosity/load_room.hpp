#pragma once
// Rooms from files.

#include <istream>
#include <string>

#include "renderer/radiosity/room.hpp"

namespace radiosity {

/// Reads a file, by its ending: .room (ours, see read_room), .nff or .obj. BadScene "file:line:
/// found ..., expected ..."; the room has passed check().
Room load_room(const std::string& path);

/// The text format: one statement a line, `#` starts a comment.
///   material NAME reflect R G B [emit R G B]    mirror NAME reflect R G B
///   quad MATERIAL  x y z  x y z  x y z  x y z  [divide N M] [two-sided]
///   polygon MATERIAL  x y z ... [divide N] [two-sided]
///   crease x y z  x y z
///   view from x y z at x y z up x y z angle DEGREES size W H
Room read_room(std::istream& in, const std::string& name);

/// NFF: polygons and patches (f: reflectance kd times colour, a mirror where ks is 1 and kd 0);
/// `# emit R G B` before a polygon. BadScene for spheres and cones, which are not flat.
Room read_nff_room(std::istream& in, const std::string& name);

/// Wavefront OBJ with its MTL: Kd reflectance, Ke emission, a mirror where illum is 3 and Ks its
/// reflectance; normals (vn) where a face has them. An OBJ has no view: it is looked at from
/// outside, along the diagonal of its bounds.
Room load_obj_room(const std::string& path);

}  // namespace radiosity

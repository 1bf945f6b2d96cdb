#pragma once
// Rooms from Wavefront OBJ files.

#include <string>

#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// Reads an OBJ with its MTL files; every face is one patch before MeshParams::refine. v, vn, f,
/// usemtl and mtllib count; vt, g, o and s are passed over, others are BadInput. An OBJ has no
/// view: it is looked at from outside, along the diagonal of its bounds from the greatest corner,
/// y upwards. In an MTL file Kd is the reflectance and Ke the emission, black where there is none;
/// illum 3 makes a mirror, whose reflectance is Ks. Other statements are passed over.
Room load_obj_room(const std::string& path);

}  // namespace radiosity

#pragma once
// Materials of a Wavefront MTL file.

#include <istream>
#include <string>

#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// Appends to `materials`: Kd is the reflectance and Ke the emission, black where there are none; a
/// mirror where illum is 3, Ks its reflectance. Other statements are passed over. BadInput
/// "name:line: found ..., expected ...".
void read_mtl(std::istream& in, const std::string& name, std::vector<Material>& materials);

}  // namespace radiosity

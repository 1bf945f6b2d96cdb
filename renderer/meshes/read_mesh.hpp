#pragma once
// Reader of meshes in the formats of the Open Asset Import Library (Assimp), other than NFF and
// OBJ.

#include <span>
#include <string>
#include <string_view>

#include "renderer/files/obj.hpp"
#include "renderer/files/text/left_out.hpp"

namespace renderer {

/// File extensions of the formats that read_mesh() reads, such as ".stl".
std::span<const std::string_view> mesh_endings();

/// Calls the functions of `target` for the materials and triangles of a file. The transformations
/// of nodes are applied in single precision. `left_out` counts ignored parts: animations, lights,
/// cameras, points, lines, vertex colours, textures other than colour maps, and triangles without
/// an area. Throws BadInput if the file cannot be read, has no triangle, or has corners that are
/// invalid in a scene. Call it in a separate process, because damaged files can make Assimp abort
/// or hang.
void read_mesh(const std::string& path, ObjTarget& target, LeftOut& left_out);

}  // namespace renderer

#pragma once
// Reader of meshes in further formats, based on the Open Asset Import Library (Assimp).

#include <span>
#include <string>
#include <string_view>

#include "renderer/files/obj.hpp"
#include "renderer/files/text/left_out.hpp"

namespace renderer {

/// File extensions that can be read, such as ".stl".
std::span<const std::string_view> mesh_endings();

/// Sends the triangles of a file and their materials to `target`. Transformations of nodes are
/// applied in single precision. `left_out` counts what is left out: animations, lights, cameras,
/// points, lines, vertex colours, textures other than colour maps, and triangles without an area.
/// Throws BadInput if the file cannot be read, has no triangle, or has corners that are invalid in
/// a scene. Call it in a separate process, since damaged files can make the library abort or hang.
void read_mesh(const std::string& path, ObjTarget& target, LeftOut& left_out);

}  // namespace renderer

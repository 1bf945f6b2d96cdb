#pragma once
// Meshes in other formats, read by the Open Asset Import Library (Assimp).

#include <span>
#include <string>
#include <string_view>

#include "renderer/files/left_out.hpp"
#include "renderer/files/obj.hpp"

namespace renderer {

/// Endings of the files that can be read: ".stl" and others.
std::span<const std::string_view> mesh_endings();

/// Sends `target` the triangles of a file, transformed by its nodes, and their materials. Left out:
/// animations, lights, cameras, points, lines, vertex colours, pictures other than colour maps, and
/// triangles without an area. Numbers have single precision. BadInput if the file cannot be read,
/// has no triangle, or has corners that are invalid in a scene. Damaged files can make the library
/// abort the process or hang: call it in a process of its own.
void read_mesh(const std::string& path, ObjTarget& target, LeftOut& left_out);

}  // namespace renderer

#pragma once
// Meshes in formats of others, read by the Open Asset Import Library (Assimp).

#include <span>
#include <string>
#include <string_view>

#include "renderer/files/left_out.hpp"
#include "renderer/files/obj.hpp"

namespace renderer {

/// Endings of the files that are read: ".stl" and others.
std::span<const std::string_view> mesh_endings();

/// Tells `target` the triangles of a file, where its nodes put them, and their materials. Left out:
/// animations, lights, cameras, points, lines, colours of corners, pictures of other things than
/// colours, and triangles without an area. Numbers are of single precision. BadInput if the file
/// cannot be read, has no triangle, or has corners that no scene may have. The library can abort
/// the process for a file that is damaged, or not end: call it where that does no harm.
void read_mesh(const std::string& path, ObjTarget& target, LeftOut& left_out);

}  // namespace renderer

#pragma once
// Rooms from files.

#include <string>

#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// Reads a file, by its ending: .room (read_room.hpp), .nff (nff_room.hpp) or .obj (obj_room.hpp).
/// BadInput "file:line: found ..., expected ..."; the room has passed check().
Room load_room(const std::string& path);

}  // namespace radiosity

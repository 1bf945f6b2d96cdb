#pragma once
// Writes rooms in the formats of load_room.hpp. Counts parts that a format cannot express.

#include "renderer/files/nff.hpp"
#include "renderer/files/obj.hpp"
#include "renderer/files/text/left_out.hpp"
#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// Formats a room as .room text. Normals at corners are omitted and counted in `left_out`.
std::string to_text(const Room& room, renderer::LeftOut& left_out);

// Calls the functions of `target` for the parts of a room. Two-sided faces become two faces.
// Creases, divisions and names of materials are omitted. Mirrors in NFF reflect all light, because
// NFF has no reflectance of mirrors.
void tell(const Room& room, renderer::ObjTarget& target, renderer::LeftOut& left_out);
void tell(const Room& room, renderer::NffTarget& target, renderer::LeftOut& left_out);

}  // namespace radiosity

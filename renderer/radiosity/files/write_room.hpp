#pragma once
// Writers of rooms in the formats of load_room.hpp. They count what a format cannot express.

#include "renderer/files/nff.hpp"
#include "renderer/files/obj.hpp"
#include "renderer/files/text/left_out.hpp"
#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// Formats a room as .room, without normals.
std::string to_text(const Room& room, renderer::LeftOut& left_out);

// Sends a room to a target. Two-sided faces become two faces. Creases, divisions and names of
// materials are left out. In NFF, mirrors reflect all light, since it cannot express their
// absorption.
void tell(const Room& room, renderer::ObjTarget& target, renderer::LeftOut& left_out);
void tell(const Room& room, renderer::NffTarget& target, renderer::LeftOut& left_out);

}  // namespace radiosity

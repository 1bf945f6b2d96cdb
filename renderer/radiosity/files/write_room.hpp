#pragma once
// Writes rooms in the formats of load_room.hpp, and counts what a format cannot express.

#include "renderer/files/left_out.hpp"
#include "renderer/files/nff.hpp"
#include "renderer/files/obj.hpp"
#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// The text of a .room. Left out: normals.
std::string to_text(const Room& room, renderer::LeftOut& left_out);

// Send a room to a target; two-sided faces become two faces. Left out: creases, divisions, names of
// materials; in an NFF also the absorption of mirrors, which reflect all.
void tell(const Room& room, renderer::ObjTarget& target, renderer::LeftOut& left_out);
void tell(const Room& room, renderer::NffTarget& target, renderer::LeftOut& left_out);

}  // namespace radiosity

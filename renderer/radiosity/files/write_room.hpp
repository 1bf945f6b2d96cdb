#pragma once
// Rooms in the formats of load_room.hpp. What a format has no word for is counted.

#include "renderer/files/left_out.hpp"
#include "renderer/files/nff.hpp"
#include "renderer/files/obj.hpp"
#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

/// The text of a .room. Left out: normals.
std::string to_text(const Room& room, renderer::LeftOut& left_out);

// Tell a target the room; faces of two sides as two faces. Left out: creases, divisions, names of
// materials; of an NFF also what its mirrors, which reflect all, do not.
void tell(const Room& room, renderer::ObjTarget& target, renderer::LeftOut& left_out);
void tell(const Room& room, renderer::NffTarget& target, renderer::LeftOut& left_out);

}  // namespace radiosity

#pragma once
// What the readers of rooms share: parts of a room are checked and added. Errors are BadInput
// "name:line: found ..., expected ...".

#include "renderer/files/tokens.hpp"
#include "renderer/radiosity/room/room.hpp"

namespace radiosity {

using renderer::Tokens;

/// Adds a material that stands at a line; no other may have its name.
void add_material(const Tokens& tokens, int line, const Material& material,
                  std::vector<Material>& materials);
/// Takes a material's name and returns its index. `where` says what names it: "lines above".
std::uint32_t take_material(Tokens& tokens, const Room& room, std::string_view where);
/// Adds a face that stands at a line.
void add_face(const Tokens& tokens, int line, Face face, Room& room);

}  // namespace radiosity

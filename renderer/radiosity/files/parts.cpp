#include "renderer/radiosity/files/parts.hpp"

#include <fmt/format.h>

#include "base/text.hpp"
#include "renderer/radiosity/room/check.hpp"

namespace radiosity {

void add_material(const Tokens& tokens, int line, const Material& material,
                  std::vector<Material>& materials) {
  tokens.at_line(line, [&] { check_material(material); });
  if (std::ranges::find(materials, material.name, &Material::name) != materials.end())
    tokens.fail(line, fmt::format("found a second material {}, expected another name",
                                  base::quote(material.name)));
  materials.push_back(material);
}

std::uint32_t take_material(Tokens& tokens, const Room& room, std::string_view where) {
  std::string known;
  for (std::uint32_t i = 0; i < room.materials.size(); ++i) {
    if (tokens.take_if(room.materials[i].name)) return i;
    known += (i == 0 ? "" : ", ") + room.materials[i].name;
  }
  tokens.fail_next(
      fmt::format("a material of the {}: {}", where, known.empty() ? "none yet" : known));
}

void add_face(const Tokens& tokens, int line, Face face, Room& room) {
  face.where = fmt::format("{}:{}", tokens.name(), line);
  tokens.at_line(line, [&] { check_face(face, room.materials.size()); });
  room.faces.push_back(std::move(face));
}

}  // namespace radiosity

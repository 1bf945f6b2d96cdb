#include <fmt/format.h>

#include <optional>
#include <sstream>

#include "renderer/files/nff_statements.hpp"
#include "renderer/radiosity/files/load_room.hpp"
#include "renderer/radiosity/room/check.hpp"

namespace radiosity {

namespace {

struct Reader {
  renderer::Tokens tokens;
  std::string name;  // of the file
  Room room{};
  int view_line = 0;
  std::optional<Material> material{};  // of the faces to come
  bool used = false;                   // it is the last of the room's materials
};

// The same lines, but `# emit` without its '#', as a statement.
std::stringstream uncover_emission(std::istream& in) {
  std::stringstream out;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string hash, emit;
    words >> hash >> emit;
    if (hash == "#" && emit == "emit") line[line.find('#')] = ' ';
    if (hash == "#emit") line[line.find('#')] = ' ';
    out << line << '\n';
  }
  return out;
}

void read_view(Reader& r) {
  const int line = r.tokens.line();
  if (r.view_line != 0)
    r.tokens.fail(line,
                  fmt::format("found a second 'v', expected one, that of line {}", r.view_line));
  r.view_line = line;
  const renderer::View view = take_view(r.tokens);
  at_line(r.tokens, line, [&] { r.room.view = check_view(view); });
}

void read_surface(Reader& r) {
  const int line = r.tokens.line();
  const renderer::Surface s = take_surface(r.tokens);
  if (s.t > 0) r.tokens.fail(line, fmt::format("found T {}, expected 0: opaque surfaces", s.t));
  Material m;
  m.name = fmt::format("line {}", line);
  m.mirror = s.ks == 1 && s.kd == 0;
  m.reflectance = m.mirror ? Rgb{1, 1, 1} : s.kd * s.colour;
  at_line(r.tokens, line, [&] { check_material(m); });
  r.material = m;
  r.used = false;
}

void require_surface(const Reader& r, int line, std::string_view found) {
  if (!r.material)
    r.tokens.fail(line, fmt::format("found '{}', expected a surface ('f') before it", found));
}

void read_emission(Reader& r) {
  const int line = r.tokens.line();
  require_surface(r, line, "# emit");
  for (double Rgb::*part : {&Rgb::r, &Rgb::g, &Rgb::b})
    r.material->emission.*part = r.tokens.take_number("an emission");
  at_line(r.tokens, line, [&] { check_material(*r.material); });
  r.material->name = fmt::format("line {}", line);
  r.used = false;
}

void read_polygon(Reader& r, bool with_normals) {
  const int line = r.tokens.line();
  require_surface(r, line, with_normals ? "pp" : "p");
  renderer::Outline outline = take_outline(r.tokens, with_normals);
  if (!r.used) r.room.materials.push_back(*r.material);
  r.used = true;
  Face face;
  face.corners = std::move(outline.corners);
  face.normals = std::move(outline.normals);
  face.material = static_cast<std::uint32_t>(r.room.materials.size() - 1);
  face.where = fmt::format("{}:{}", r.name, line);
  at_line(r.tokens, line, [&] { check_face(face, r.room.materials.size()); });
  r.room.faces.push_back(std::move(face));
}

void read_statement(Reader& r) {
  constexpr std::string_view NAMES[] = {"v", "b", "l", "f", "emit", "p", "pp", "s", "c"};
  const auto* name = std::find(std::begin(NAMES), std::end(NAMES), r.tokens.peek());
  if (name == std::end(NAMES)) r.tokens.fail_next("a statement: v, b, l, f, # emit, p or pp");
  r.tokens.take();
  switch (name - NAMES) {
    case 0:
      return read_view(r);
    case 1:
      r.tokens.take_rgb("the background");
      return;
    case 2:
      r.tokens.take_vec("the light's position");
      if (r.tokens.continues()) r.tokens.take_rgb("the light's colour");
      return;
    case 3:
      return read_surface(r);
    case 4:
      return read_emission(r);
    case 5:
      return read_polygon(r, false);
    case 6:
      return read_polygon(r, true);
    default:
      r.tokens.fail(r.tokens.line(), fmt::format("found a {} ('{}'), expected flat faces: p or pp",
                                                 *name == "s" ? "sphere" : "cone", *name));
  }
}

}  // namespace

Room read_nff_room(std::istream& in, const std::string& name) {
  std::stringstream lines = uncover_emission(in);
  Reader r{renderer::Tokens(lines, name), name};
  while (!r.tokens.peek().empty()) read_statement(r);
  if (r.view_line == 0) r.tokens.fail_next("a view ('v')");
  check_light(r.room, name);
  return std::move(r.room);
}

}  // namespace radiosity

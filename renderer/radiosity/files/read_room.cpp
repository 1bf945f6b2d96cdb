#include <fmt/format.h>

#include "renderer/files/nff_statements.hpp"
#include "renderer/radiosity/files/load_room.hpp"
#include "renderer/radiosity/files/statement.hpp"
#include "renderer/radiosity/room/check.hpp"

namespace radiosity {

namespace {

constexpr int MAX_DIVISIONS = 10000, MAX_SIDE = 65536;

struct Reader {
  renderer::Tokens tokens;
  std::string name;  // of the file
  Room room{};
  int view_line = 0;
  std::vector<int> crease_lines{};
};

std::string list_names(const std::vector<Material>& materials) {
  std::string list;
  for (const Material& m : materials) list += (list.empty() ? "" : ", ") + m.name;
  return list.empty() ? "none yet" : list;
}

std::uint32_t take_material(Reader& r, Statement& s) {
  const std::string_view name = s.peek();
  for (std::uint32_t i = 0; i < r.room.materials.size(); ++i)
    if (r.room.materials[i].name == name) {
      s.take_word("");
      return i;
    }
  s.fail_next(fmt::format("a material of the lines above: {}", list_names(r.room.materials)));
}

void read_material(Reader& r, Statement& s, bool mirror) {
  Material m;
  m.name = s.take_word("a name");
  m.mirror = mirror;
  for (const Material& other : r.room.materials)
    if (other.name == m.name)
      s.fail(fmt::format("found a second material {}, expected another name",
                         renderer::quote(m.name)));
  if (!s.take_if("reflect")) s.fail_next("'reflect'");
  m.reflectance = s.take_rgb("a reflectance");
  if (!mirror && s.take_if("emit")) m.emission = s.take_rgb("an emission");
  s.end();
  at_line(r.tokens, s.line(), [&] { check_material(m); });
  r.room.materials.push_back(m);
}

void add_face(Reader& r, const Statement& s, Face face) {
  face.where = fmt::format("{}:{}", r.name, s.line());
  at_line(r.tokens, s.line(), [&] { check_face(face, r.room.materials.size()); });
  r.room.faces.push_back(std::move(face));
}

// `corners`: how many; 0: as many as there are.
void read_face(Reader& r, Statement& s, int corners) {
  Face face;
  face.material = take_material(r, s);
  const auto ends = [&] {
    return s.peek().empty() || s.peek() == "divide" || s.peek() == "two-sided";
  };
  for (int i = 0; corners > 0 ? i < corners : i < 3 || !ends(); ++i)
    face.corners.push_back(s.take_vec(fmt::format("corner {}", i + 1)));
  if (s.take_if("divide")) {
    face.along = s.take_count("patches along the first edge", 1, MAX_DIVISIONS);
    face.across = corners == 4 ? s.take_count("patches across it", 1, MAX_DIVISIONS) : face.along;
  }
  face.two_sided = s.take_if("two-sided");
  if (!s.peek().empty()) s.fail_next("'divide', then 'two-sided', or the end of the line");
  add_face(r, s, std::move(face));
}

// Six quads, of each the front outside, or inside.
void read_box(Reader& r, Statement& s) {
  Face face;
  face.material = take_material(r, s);
  const Vec ends[] = {s.take_vec("the least corner"), s.take_vec("the greatest corner")};
  for (int axis = 0; axis < 3; ++axis)
    if (!(ends[0][axis] < ends[1][axis]))
      s.fail(fmt::format("found a box from {} to {} along {}, expected the least corner first",
                         ends[0][axis], ends[1][axis], "xyz"[axis]));
  if (s.take_if("divide"))
    face.along = face.across = s.take_count("patches along every edge", 1, MAX_DIVISIONS);
  const bool inside = s.take_if("inside");
  if (!s.peek().empty()) s.fail_next("'divide', then 'inside', or the end of the line");
  for (int axis = 0; axis < 3; ++axis)
    for (const int end : {0, 1}) {
      face.corners.clear();
      for (const auto& [next, last] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
        // Counter-clockwise as seen from the greatest end of the axis; else the other way round.
        const bool seen = (end == 1) != inside;
        double at[3];
        at[axis] = ends[end][axis];
        at[(axis + 1) % 3] = ends[seen ? next : last][(axis + 1) % 3];
        at[(axis + 2) % 3] = ends[seen ? last : next][(axis + 2) % 3];
        face.corners.push_back({at[0], at[1], at[2]});
      }
      add_face(r, s, face);
    }
}

void read_crease(Reader& r, Statement& s) {
  Crease crease;
  crease.a = s.take_vec("one end");
  crease.b = s.take_vec("the other end");
  s.end();
  at_line(r.tokens, s.line(), [&] { check_crease(crease); });
  r.room.creases.push_back(crease);
  r.crease_lines.push_back(s.line());
}

void read_view(Reader& r, Statement& s) {
  if (r.view_line != 0)
    s.fail(fmt::format("found a second view, expected one, that of line {}", r.view_line));
  r.view_line = s.line();
  renderer::View view;
  const auto take = [&](const char* name) {
    if (!s.take_if(name)) s.fail_next(fmt::format("'{}'", name));
  };
  take("from");
  view.from = s.take_vec("from");
  take("at");
  view.at = s.take_vec("at");
  take("up");
  view.up = s.take_vec("up");
  take("angle");
  view.angle = s.take_number("the angle of the picture's height in degrees");
  take("size");
  view.width = s.take_count("the picture's width", 1, MAX_SIDE);
  view.height = s.take_count("the picture's height", 1, MAX_SIDE);
  s.end();
  at_line(r.tokens, s.line(), [&] { r.room.view = check_view(view); });
}

void read_statement(Reader& r) {
  constexpr std::string_view NAMES[] = {"material", "mirror", "quad", "polygon",
                                        "box",      "crease", "view"};
  const auto* name = std::find(std::begin(NAMES), std::end(NAMES), r.tokens.peek());
  if (name == std::end(NAMES))
    r.tokens.fail_next("a statement: material, mirror, quad, polygon, box, crease or view");
  r.tokens.take();
  Statement s(r.tokens);
  switch (name - NAMES) {
    case 0:
      return read_material(r, s, false);
    case 1:
      return read_material(r, s, true);
    case 2:
      return read_face(r, s, 4);
    case 3:
      return read_face(r, s, 0);
    case 4:
      return read_box(r, s);
    case 5:
      return read_crease(r, s);
    case 6:
      return read_view(r, s);
  }
}

}  // namespace

Room read_room(std::istream& in, const std::string& name) {
  Reader r{renderer::Tokens(in, name), name};
  while (!r.tokens.peek().empty()) read_statement(r);
  if (r.view_line == 0) r.tokens.fail_next("a view");
  check_light(r.room, name);
  for (std::size_t i = 0; i < r.crease_lines.size(); ++i)
    if (!lies_on_a_face(r.room.creases[i], r.room))
      r.tokens.fail(r.crease_lines[i],
                    "found a crease on no face, expected both ends in a plane "
                    "of one");
  return std::move(r.room);
}

}  // namespace radiosity

#include "renderer/radiosity/files/load_room.hpp"

#include <algorithm>

#include "base/text.hpp"
#include "base/whole_file.hpp"
#include "renderer/files/nff.hpp"
#include "renderer/files/obj.hpp"
#include "renderer/files/text/tokens.hpp"
#include "renderer/radiosity/room/check.hpp"

namespace radiosity {

namespace {

using renderer::at_place;
using renderer::LeftOut;
using renderer::Tokens;

// Adds a material, which the file states on line `line`. Throws BadInput if there is a material
// with its name.
void add_material(const Tokens& tokens, int line, const Material& material,
                  std::vector<Material>& materials) {
  tokens.at_line(line, [&] { check_material(material); });
  if (std::ranges::find(materials, material.name, &Material::name) != materials.end())
    tokens.fail(line, fmt::format("found a second material {}, expected another name",
                                  base::quote(material.name)));
  materials.push_back(material);
}

// Takes the name of a material and returns its index. `where` says in error messages where
// materials are defined, such as "lines above".
std::uint32_t take_material(Tokens& tokens, const Room& room, std::string_view where) {
  std::string known;
  for (std::uint32_t i = 0; i < room.materials.size(); ++i) {
    if (tokens.take_if(room.materials[i].name)) return i;
    known += (i == 0 ? "" : ", ") + room.materials[i].name;
  }
  tokens.fail_next(
      fmt::format("a material of the {}: {}", where, known.empty() ? "none yet" : known));
}

// Adds a face, which the file states on line `line`, to the room.
void add_face(const Tokens& tokens, int line, Face face, Room& room) {
  face.where = fmt::format("{}:{}", tokens.name(), line);
  tokens.at_line(line, [&] { check_face(face, room.materials.size()); });
  room.faces.push_back(std::move(face));
}

// Reader of .room files.
class RoomReader {
 public:
  RoomReader(std::string_view text, const std::string& name) : tokens_(text, name) {}

  Room read() {
    while (tokens_.begin_line()) read_statement();
    if (view_line_ == 0) tokens_.fail_next("a view");
    at_place(tokens_.name(), [&] { check_light(room_); });
    for (std::size_t i = 0; i < crease_lines_.size(); ++i)
      if (!lies_on_a_face(room_.creases[i], room_))
        tokens_.fail(
            crease_lines_[i],
            "found a crease that lies on no face, expected both ends in the plane of one face");
    return std::move(room_);
  }

 private:
  void read_statement() {
    using Read = void (*)(RoomReader&);
    constexpr std::pair<std::string_view, Read> STATEMENTS[] = {
        {"material", [](RoomReader& r) { r.read_material(false); }},
        {"mirror", [](RoomReader& r) { r.read_material(true); }},
        {"quad", [](RoomReader& r) { r.read_face(4); }},
        {"polygon", [](RoomReader& r) { r.read_face({}); }},
        {"box", [](RoomReader& r) { r.read_box(); }},
        {"crease", [](RoomReader& r) { r.read_crease(); }},
        {"view", [](RoomReader& r) { r.read_view(); }}};
    tokens_.take_choice(STATEMENTS,
                        "a statement: material, mirror, quad, polygon, box, crease or view")(*this);
  }

  void take_name(std::string_view name) {
    if (!tokens_.take_if(name)) tokens_.fail_next(fmt::format("'{}'", name));
  }

  void read_material(bool mirror) {
    Material m;
    m.mirror = mirror;
    m.name = tokens_.take_word("a name");
    take_name("reflect");
    m.reflectance = tokens_.take_rgb("a reflectance");
    if (tokens_.take_if("emit")) m.emission = tokens_.take_rgb("an emission");
    tokens_.end_line();
    add_material(tokens_, tokens_.line(), m, room_.materials);
  }

  int take_divisions(std::string_view what) { return tokens_.take_count(what, 1, MAX_DIVISIONS); }

  // Reads a face with the given number of corners. Without a number, the rest of the line lists the
  // corners.
  void read_face(std::optional<int> corners) {
    Face face;
    face.material = take_material(tokens_, room_, "lines above");
    const auto ends = [&] {
      const auto word = tokens_.peek();
      return word.empty() || word == "divide" || word == "two-sided";
    };
    for (int i = 0; corners ? i < *corners : i < 3 || !ends(); ++i)
      face.corners.push_back(tokens_.take_vec(fmt::format("corner {}", i + 1)));
    if (tokens_.take_if("divide")) {
      face.along = take_divisions("patches along the first edge");
      face.across = corners ? take_divisions("patches along the second edge") : face.along;
    }
    face.two_sided = tokens_.take_if("two-sided");
    if (tokens_.continues())
      tokens_.fail_next("'divide', then 'two-sided', or the end of the line");
    add_face(tokens_, tokens_.line(), std::move(face), room_);
  }

  // Reads a box as six quads, whose fronts face outwards, or inwards if `inside` is stated.
  void read_box() {
    const int line = tokens_.line();
    Face face;
    face.material = take_material(tokens_, room_, "lines above");
    const Vec ends[] = {tokens_.take_vec("the corner with the smallest coordinates"),
                        tokens_.take_vec("the corner with the largest coordinates")};
    for (int axis = 0; axis < 3; ++axis)
      if (!(ends[0][axis] < ends[1][axis]))
        tokens_.fail(line, fmt::format("found a box from {} to {} along {}, expected the corner "
                                       "with the smallest coordinates first",
                                       ends[0][axis], ends[1][axis], "xyz"[axis]));
    if (tokens_.take_if("divide"))
      face.along = face.across = take_divisions("patches along every edge");
    const bool inside = tokens_.take_if("inside");
    if (tokens_.continues()) tokens_.fail_next("'divide', then 'inside', or the end of the line");
    for (int axis = 0; axis < 3; ++axis)
      for (const int end : {0, 1}) {
        face.corners.clear();
        for (const auto& [next, last] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
          // True if the front faces along the positive axis. The corners are then counter-clockwise
          // as seen from the positive end of the axis. If the front faces along the negative axis,
          // they are clockwise.
          const bool seen = (end == 1) != inside;
          double at[3];
          at[axis] = ends[end][axis];
          at[(axis + 1) % 3] = ends[seen ? next : last][(axis + 1) % 3];
          at[(axis + 2) % 3] = ends[seen ? last : next][(axis + 2) % 3];
          face.corners.push_back({at[0], at[1], at[2]});
        }
        add_face(tokens_, line, face, room_);
      }
  }

  void read_crease() {
    Crease crease;
    crease.a = tokens_.take_vec("one end");
    crease.b = tokens_.take_vec("the other end");
    tokens_.end_line();
    tokens_.at_line(tokens_.line(), [&] { check_crease(crease); });
    room_.creases.push_back(crease);
    crease_lines_.push_back(tokens_.line());
  }

  void read_view() {
    const int line = tokens_.line();
    if (view_line_ != 0)
      tokens_.fail(line,
                   fmt::format("found a second view, expected only that of line {}", view_line_));
    view_line_ = line;
    renderer::View view;
    for (const auto& [name, vec] :
         {std::pair{"from", &view.from}, {"at", &view.at}, {"up", &view.up}}) {
      take_name(name);
      *vec = tokens_.take_vec(name);
    }
    take_name("angle");
    view.angle = tokens_.take_number("the vertical angle of view in degrees");
    take_name("size");
    view.width = tokens_.take_count("the picture's width", 1, renderer::MAX_SIDE);
    view.height = tokens_.take_count("the picture's height", 1, renderer::MAX_SIDE);
    tokens_.end_line();
    tokens_.at_line(line, [&] { room_.view = check_view(view); });
  }

  Tokens tokens_;
  Room room_;
  int view_line_ = 0;
  std::vector<int> crease_lines_;  // line number of each crease
};

// An NFF target that builds a room.
struct RoomTarget : renderer::NffTarget {
  RoomTarget(std::string file, LeftOut& left) : name(std::move(file)), left_out(left) {}

  std::string name;  // name of the file
  LeftOut& left_out;
  Room room;
  Material material;  // material of the next faces
  bool used = false;  // `material` is the last one in the room's list

  Knows knows() const override { return Knows::rooms; }
  void set_view(const renderer::View& view) override { room.view = check_view(view); }
  void set_background(const Rgb&) override { left_out.add("backgrounds"); }
  void add_light(const renderer::Light&, const std::optional<Rgb>&) override {
    left_out.add("lights");
  }

  void set_surface(const renderer::Surface& s) override {
    if (s.t > 0) throw BadInput(fmt::format("found T {}, expected 0 (opaque surfaces)", s.t));
    const bool mirror = s.ks == 1 && s.kd == 0;
    if (s.ks > 0 && !mirror) left_out.add("partial reflections");
    set_material({{}, mirror ? Rgb{1, 1, 1} : s.kd * s.colour, {}, mirror});
  }
  void set_emission(const Rgb& emission) override {
    Material emitting = material;
    emitting.emission = emission;
    set_material(emitting);
  }
  void set_material(const Material& next) {
    check_material(next);
    material = next;
    material.name = fmt::format("line {}", line);
    used = false;
  }

  void add_polygon(std::vector<Vec> corners, std::vector<Vec> normals) override {
    if (!used) room.materials.push_back(material);
    used = true;
    Face face;
    face.corners = std::move(corners);
    face.normals = std::move(normals);
    face.material = static_cast<std::uint32_t>(room.materials.size() - 1);
    face.where = fmt::format("{}:{}", name, line);
    check_face(face, room.materials.size());
    room.faces.push_back(std::move(face));
  }
  void add_sphere(const Vec&, double) override { refuse("a sphere ('s')"); }
  void add_cone(const Vec&, double, const Vec&, double) override { refuse("a cone ('c')"); }
  [[noreturn]] static void refuse(const char* found) {
    throw BadInput(fmt::format("found {}, expected flat faces: p or pp", found));
  }
};

// An OBJ target that builds a room.
struct ObjRoom : renderer::ObjTarget {
  ObjRoom(std::string file, LeftOut& left) : name(std::move(file)), left_out(left) {}

  std::string name;  // name of the file
  LeftOut& left_out;
  Room room;
  std::uint32_t material = 0;  // index of the material of the next faces
  std::optional<renderer::View> view;

  void add_material(const renderer::MtlMaterial& m) override {
    const bool mirror = m.illum == renderer::ILLUM_REFLECTS;
    if (m.illum > renderer::ILLUM_REFLECTS && m.specular != Rgb{})
      left_out.add("partial reflections");
    if (m.illum < renderer::ILLUM_REFLECTS && m.specular != Rgb{})
      left_out.add("highlights without mirror reflection");
    if (m.transparency > 0) left_out.add("transparent materials");
    if (!m.picture.empty()) left_out.add("pictures");
    room.materials.push_back({m.name, mirror ? m.specular : m.diffuse, m.emission, mirror});
    check_material(room.materials.back());
  }
  void use_material(std::size_t index) override { material = static_cast<std::uint32_t>(index); }
  void set_view(const renderer::View& said) override { view = said; }
  void set_background(const Rgb&) override { left_out.add("backgrounds"); }
  void add_light(const renderer::Light&, const std::optional<Rgb>&) override {
    left_out.add("lights");
  }

  void add_face(std::vector<Vec> corners, std::vector<Vec> normals,
                std::vector<renderer::Corner>) override {
    const renderer::ObjFace whole{std::move(corners), std::move(normals), {}};
    std::vector<renderer::ObjFace> parts{whole};
    if (whole.corners.size() > 3 && !is_valid(make_face(whole.corners, {})))
      parts = cut_into_triangles(whole);
    std::vector<Face> faces;
    for (const auto& part : parts) {
      faces.push_back(make_face(part.corners, part.normals));
      if (!is_valid(faces.back()) && !faces.back().normals.empty()) {
        left_out.add("normals of faces");
        faces.back().normals.clear();
      }
      check_face(faces.back(), room.materials.size());
    }
    std::ranges::move(faces, std::back_inserter(room.faces));
  }

  Face make_face(const std::vector<Vec>& corners, const std::vector<Vec>& normals) const {
    Face face;
    face.corners = corners;
    face.normals = normals;
    face.material = material;
    face.where = fmt::format("{}:{}", name, line);
    return face;
  }
  bool is_valid(const Face& face) const {
    try {
      check_face(face, room.materials.size());
      return true;
    } catch (const BadInput&) {
      return false;
    }
  }
};

Room read_obj_room(std::string_view text, const std::string& name, LeftOut& left_out) {
  ObjRoom target(name, left_out);
  read_obj(text, name, target, left_out);
  at_place(name, [&] {
    Room& room = target.room;
    check_light(room);
    room.view = check_view(target.view.value_or(renderer::look_from_outside(eval_bounds(room))));
  });
  return std::move(target.room);
}

Room read_nff_room(std::string_view text, const std::string& name, LeftOut& left_out) {
  RoomTarget target(name, left_out);
  read_nff(text, name, target);
  at_place(name, [&] { check_light(target.room); });
  return std::move(target.room);
}

using Read = Room (*)(std::string_view text, const std::string& name, LeftOut& left_out);

Read find_reader(const std::string& name) {
  const std::string lower = base::to_lower(name);
  if (lower.ends_with(".room"))
    return [](std::string_view text, const std::string& n, LeftOut&) {
      return RoomReader(text, n).read();
    };
  if (lower.ends_with(".obj")) return &read_obj_room;
  if (lower.ends_with(".nff")) return &read_nff_room;
  throw BadInput(fmt::format(
      "{}: found another ending in the name of a room, expected .room, .nff or .obj", name));
}

// Moves a room to the origin if its distance from the origin is more than FAR times its size. The
// results are then as exact as the coordinates.
Room bring_near(Room room) {
  constexpr double FAR = 1000;
  const renderer::Bounds bounds = eval_bounds(room);
  const Vec middle = 0.5 * (bounds.lo + bounds.hi);
  if (!(max_abs(middle) > FAR * length(bounds.hi - bounds.lo))) return room;
  for (Face& face : room.faces)
    for (Vec& corner : face.corners) corner += -middle;
  for (Crease& crease : room.creases) crease = {crease.a - middle, crease.b - middle};
  room.view.from += -middle;
  room.view.at += -middle;
  return room;
}

}  // namespace

Room read_room(std::string_view text, const std::string& name, LeftOut* left_out) {
  LeftOut uncounted;
  return find_reader(name)(text, name, left_out ? *left_out : uncounted);
}

Room load_room(const std::string& path, LeftOut* left_out) {
  find_reader(path);  // throws BadInput for unknown extensions before the file is read
  return bring_near(read_room(base::read_text(path), path, left_out));
}

}  // namespace radiosity

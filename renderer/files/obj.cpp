#include "renderer/files/obj.hpp"

#include <algorithm>
#include <tuple>

#include "base/text.hpp"
#include "renderer/files/beside.hpp"
#include "renderer/files/obj_items.hpp"
#include "renderer/files/obj_materials.hpp"
#include "renderer/scene/triangulate.hpp"

namespace renderer {

namespace {

bool is_statement(std::string_view comment) {
  const Words words = first_words(comment);
  return (words.name == "v" && words.second == "from" && parse_number(words.third)) ||
         ((words.name == "b" || words.name == "l") && has_number(words)) ||
         (words.name == "light" && has_light_shape(words));
}

// Smallest height of a triangle, as a fraction of its longest edge.
constexpr double LEAST_HEIGHT = 2e-6;

// The numbers of a corner, spelled v, v/vt, v//vn or v/vt/vn. Wings3D also writes v//.
struct CornerWords {
  std::string_view v, vt, vn;
};

std::optional<CornerWords> split_corner(std::string_view word) {
  CornerWords parts;
  for (auto* part : {&parts.v, &parts.vt, &parts.vn}) {
    const auto slash = std::min(word.find('/'), word.size());
    *part = word.substr(0, slash);
    if (slash == word.size()) return parts;
    word.remove_prefix(slash + 1);
  }
  return {};  // more than two slashes are an error
}

bool is_readable(const Vec& item) { return !std::isnan(item.x); }
bool is_readable(const Corner& item) { return !std::isnan(item.u); }

// The items of one kind, such as vertices. `above` is the number of items above the current line.
template <class Item>
struct Items {
  const std::vector<Item>& all;
  const char* what;
  std::size_t above = 0;

  // Finds an item by its number. Positive numbers count from 1 at the start of the file, negative
  // ones backwards from the current line. Returns null if the item is missing or unreadable.
  const Item* find(std::string_view number) const {
    const auto n = base::parse_number<long long>(number).value_or(0);
    const auto count = static_cast<long long>(all.size()), before = static_cast<long long>(above);
    if (n == 0 || n > count || n < -before) return nullptr;
    const Item& item = all[static_cast<std::size_t>(n > 0 ? n - 1 : before + n)];
    return is_readable(item) ? &item : nullptr;
  }
};

// The normals or the texture coordinates of a face's corners.
template <class Item>
struct Attributes {
  std::vector<Item> items;
  std::string problem;  // message about the first missing or unreadable item

  void add(const Items<Item>& items_of_file, std::string_view number) {
    if (number.empty()) return;
    if (const Item* item = items_of_file.find(number))
      items.push_back(*item);
    else if (problem.empty())
      problem = fmt::format("found {}, expected the number of a usable {}", base::quote(number),
                            items_of_file.what);
  }
};

ObjFace pick(const ObjFace& face, std::span<const std::uint32_t> corners) {
  ObjFace part;
  for (const auto i : corners) {
    part.corners.push_back(face.corners[i]);
    if (!face.normals.empty()) part.normals.push_back(face.normals[i]);
    if (!face.coordinates.empty()) part.coordinates.push_back(face.coordinates[i]);
  }
  return part;
}

// Removes corners that repeat the point of the previous corner. Some programs write a triangle as a
// quadrilateral with a repeated corner.
ObjFace drop_repeated(ObjFace face) {
  std::vector<std::uint32_t> kept;
  const auto count = static_cast<std::uint32_t>(face.corners.size());
  for (std::uint32_t i = 0; i < count; ++i)
    if (face.corners[i] != face.corners[(i + 1) % count]) kept.push_back(i);
  return kept.size() == count ? std::move(face) : pick(face, kept);
}

// Statements without a counterpart in a scene. The last three have no effect with the value "off".
struct LeftOutStatement {
  std::string_view name;
  const char* what;  // name under which LeftOut counts the statement
  bool may_be_off = false;
};
constexpr const char* CURVES = "curves and curved surfaces";
constexpr LeftOutStatement LEFT_OUT[] = {{"p", "points"},
                                         {"l", "lines"},
                                         {"curv", CURVES},
                                         {"curv2", CURVES},
                                         {"surf", CURVES},
                                         {"bsp", CURVES},
                                         {"bzp", CURVES},
                                         {"cdc", CURVES},
                                         {"cdp", CURVES},
                                         {"call", "calls to other files"},
                                         {"csh", "shell commands"},
                                         {"shadow_obj", "objects for shadows"},
                                         {"trace_obj", "objects for reflections"},
                                         {"usemap", "texture maps of faces", true},
                                         {"lod", "levels of detail", true},
                                         {"bevel", "bevels", true}};

// Statements without effect on the scene. ObjMaterials has already read the libraries ("mtllib").
constexpr std::string_view SKIPPED[] = {"mtllib",   "g",        "o",     "s",     "mg",    "vp",
                                        "cstype",   "deg",      "bmat",  "step",  "parm",  "trim",
                                        "hole",     "scrv",     "sp",    "end",   "con",   "res",
                                        "c_interp", "d_interp", "ctech", "stech", "maplib"};

class ObjReader {
 public:
  ObjReader(std::string_view text, const std::string& path, ObjTarget& target, LeftOut& left_out)
      : tokens_(text, path, &is_statement, Tokens::Lines::joined),
        target_(target),
        left_out_(left_out),
        items_(read_items(text, path, left_out)),
        materials_(path, items_.libraries, target, left_out) {}

  void read() {
    while (tokens_.begin_line()) read_statement();
    if (faces_ == 0)
      for (const auto& problem : {unknown_, items_.problem, bad_face_})
        if (!problem.empty()) throw base::BadInput(problem);
    if (grey_ > 0)
      left_out_.replace("faces in light grey",
                        materials_.missing() > 0 ? materials_.missing_remark() : why_grey_, grey_);
    else
      left_out_.add("libraries", materials_.missing_remark(), materials_.missing());
  }

 private:
  void read_statement() {
    static constexpr std::pair<std::string_view, void (*)(ObjReader&)> STATEMENTS[] = {
        {"v", [](ObjReader& r) { r.count(r.points_.above); }},
        {"vt", [](ObjReader& r) { r.count(r.coordinates_.above); }},
        {"vn", [](ObjReader& r) { r.count(r.normals_.above); }},
        {"f", [](ObjReader& r) { r.read_face(); }},
        {"fo", [](ObjReader& r) { r.read_face(); }},  // old name of the statement 'f'
        {"usemtl", [](ObjReader& r) { r.use_material(); }},
        {"#", [](ObjReader& r) { r.read_comment(); }}};
    const auto word = tokens_.take();
    target_.line = tokens_.line();
    const auto name = base::to_lower(word);
    for (const auto& [known, read] : STATEMENTS)
      if (known == name) return read(*this);
    for (const auto& known : LEFT_OUT)
      if (known.name == name) return leave_out(known);
    if (std::ranges::find(SKIPPED, name) == std::end(SKIPPED)) return read_unknown(word);
    tokens_.take_rest();
  }

  void read_unknown(std::string_view word) {
    const auto remark = at_line(
        fmt::format("found {}, expected a statement: v, vt, vn, f, g, o, s, usemtl, mtllib or "
                    "another of OBJ",
                    base::quote(word)));
    left_out_.add("unknown statements", remark);
    if (unknown_.empty()) unknown_ = remark;
    tokens_.take_rest();
  }

  void leave_out(const LeftOutStatement& statement) {
    if (!statement.may_be_off) return left_out_.add(statement.what), tokens_.skip_line();
    const auto value = base::to_lower(cut_comment(tokens_.take_rest()));
    if (value != "off" && value != "0") left_out_.add(statement.what);
  }

  void count(std::size_t& items) {
    ++items;
    tokens_.skip_line();
  }

  std::string at_line(std::string_view message) const {
    return fmt::format("{}:{}: {}", tokens_.name(), target_.line, message);
  }

  template <class Action>
  void tell(const Action& action) {
    tokens_.at_line(target_.line, action);
  }

  void use_material() {
    const auto text = tokens_.take_rest();
    material_ = materials_.find(text);
    is_told_ = false;
    if (!material_ && why_grey_.empty())
      why_grey_ = at_line(fmt::format("found the material {}, expected one of the libraries: {}",
                                      base::quote(text), materials_.describe()));
  }

  // Calls use_material() of the target for the next face unless its material is already in use.
  void tell_material() {
    if (!material_ && why_grey_.empty())
      why_grey_ = at_line("found 'f', expected 'usemtl' before it");
    if (std::exchange(is_told_, true)) return;
    const auto index = material_ ? *material_ : materials_.find_grey();
    map_ = materials_.map(index);
    tell([&] { target_.use_material(index); });
  }

  void read_comment() {
    const std::string_view name = tokens_.take();
    if (name == "v") {
      const View view = take_view(tokens_);
      tell([&] {
        require(!std::exchange(has_view_, true), "a second '# v'", "one");
        target_.set_view(view);
      });
    } else if (name == "b") {
      const Rgb colour = take_colour(tokens_, "the background");
      tell([&] { target_.set_background(colour); });
    } else {
      const auto [light, colour] = name == "l" ? take_light(tokens_) : take_area_light(tokens_);
      tell([&] { target_.add_light(light, colour); });
    }
    tokens_.end_line();
  }

  void read_face() {
    try {
      ObjFace face = drop_repeated(take_face());
      tell([&] {
        require(face.corners.size() >= 3, fmt::format("{} different corners", face.corners.size()),
                "3 or more");
      });
      tell_material();
      face.coordinates = map_coordinates(std::move(face.coordinates));
      tell([&] {
        target_.add_face(std::move(face.corners), std::move(face.normals),
                         std::move(face.coordinates));
      });
      ++faces_;
      if (!material_) ++grey_;
    } catch (const base::BadInput& bad) {
      left_out_.add("faces", bad.what());
      if (bad_face_.empty()) bad_face_ = bad.what();
      tokens_.skip_line();
    }
  }

  ObjFace take_face() {
    ObjFace face;
    Attributes<Vec> normals;
    Attributes<Corner> coordinates;
    while (!tokens_.peek().empty()) {
      const auto words = split_corner(tokens_.peek());
      const Vec* point = words ? points_.find(words->v) : nullptr;
      if (!point)
        tokens_.fail_next(
            fmt::format("the number of a readable vertex (v): 1 to {}, or -1 to -{} counted back "
                        "from this line",
                        points_.all.size(), points_.above));
      face.corners.push_back(*point);
      coordinates.add(coordinates_, words->vt);
      normals.add(normals_, words->vn);
      tokens_.take();
    }
    face.normals = take_all(normals, face.corners.size(), "normals of faces");
    face.coordinates = take_all(coordinates, face.corners.size(), "texture coordinates of faces");
    return face;
  }

  // Returns the items if every corner has one. Otherwise returns none, and counts the incomplete
  // items.
  template <class Item>
  std::vector<Item> take_all(Attributes<Item>& found, std::size_t count, const char* kind) {
    auto& [items, problem] = found;
    if (items.size() == count) return std::move(items);
    if (items.empty() && problem.empty()) return {};
    if (problem.empty())
      problem =
          fmt::format("found {} {}, expected {}, one for each corner", items.size(), kind, count);
    left_out_.add(kind, at_line(problem));
    return {};
  }

  std::vector<Corner> map_coordinates(std::vector<Corner> coordinates) {
    if (map_ == PictureMap{}) return coordinates;
    for (auto& [u, v] : coordinates) {
      u = map_.u_scale * u + map_.u_offset, v = map_.v_scale * v + map_.v_offset;
      if (std::abs(u) <= MAX_COORDINATE && std::abs(v) <= MAX_COORDINATE) continue;
      left_out_.add(
          "texture coordinates of faces",
          at_line(fmt::format("found a scaled coordinate {:g} {:g}, expected at most {:g}", u, v,
                              MAX_COORDINATE)));
      return {};
    }
    return coordinates;
  }

  Tokens tokens_;
  ObjTarget& target_;
  LeftOut& left_out_;
  const ObjItems items_;
  ObjMaterials materials_;
  Items<Vec> points_{items_.points, "vertex (v)"}, normals_{items_.normals, "normal (vn)"};
  Items<Corner> coordinates_{items_.coordinates, "coordinate (vt)"};
  // Material of the next faces; none for the light grey default.
  std::optional<std::size_t> material_;
  PictureMap map_;
  bool is_told_ = false, has_view_ = false;
  std::size_t faces_ = 0, grey_ = 0;
  std::string unknown_, bad_face_, why_grey_;  // message about the first problem of each kind
};

}  // namespace

void read_obj(std::string_view text, const std::string& name, ObjTarget& target,
              LeftOut& left_out) {
  ObjReader(text, name, target, left_out).read();
}

std::vector<ObjFace> cut_into_triangles(const ObjFace& face) {
  std::vector<ObjFace> parts;
  for (const auto& triangle : triangulate(face.corners)) {
    ObjFace part = pick(face, triangle);
    const auto& [a, b, c] = std::tie(part.corners[0], part.corners[1], part.corners[2]);
    const double longest = std::max({length(b - a), length(c - b), length(a - c)});
    if (length(cross(b - a, c - a)) > LEAST_HEIGHT * longest * longest)
      parts.push_back(std::move(part));
  }
  require(!parts.empty(), "a polygon with area 0", "vertices that are not collinear");
  return parts;
}

View look_from_outside(const Bounds& bounds) {
  View view;
  const Vec across = bounds.hi - bounds.lo;
  if (std::hypot(across.x, across.z) < 1e-3 * across.y) view.up = {0, 0, 1};
  const double sine = 0.38268343236508977;  // sine of half the view's angle of 45 degrees
  view.at = 0.5 * (bounds.lo + bounds.hi);
  view.from = view.at + (0.5 / sine) * across;
  return view;
}

}  // namespace renderer

#include "renderer/radiosity/files/read_room.hpp"

#include <fmt/format.h>

#include "renderer/radiosity/files/parts.hpp"
#include "renderer/radiosity/room/check.hpp"

namespace radiosity {

namespace {

class Reader {
 public:
  Reader(std::istream& in, const std::string& name) : tokens_(in, name) {}

  Room read() {
    while (tokens_.begin_line()) read_statement();
    if (view_line_ == 0) tokens_.fail_next("a view");
    check_light(room_, tokens_.name());
    for (std::size_t i = 0; i < crease_lines_.size(); ++i)
      if (!lies_on_a_face(room_.creases[i], room_))
        tokens_.fail(crease_lines_[i],
                     "found a crease on no face, expected both ends in a plane of one");
    return std::move(room_);
  }

 private:
  void read_statement() {
    using Read = void (Reader::*)();
    constexpr std::pair<std::string_view, Read> STATEMENTS[] = {
        {"material", &Reader::read_material}, {"mirror", &Reader::read_mirror},
        {"quad", &Reader::read_quad},         {"polygon", &Reader::read_polygon},
        {"box", &Reader::read_box},           {"crease", &Reader::read_crease},
        {"view", &Reader::read_view}};
    (this->*tokens_.take_choice(
                STATEMENTS, "a statement: material, mirror, quad, polygon, box, crease or view"))();
  }

  void take_name(std::string_view name) {
    if (!tokens_.take_if(name)) tokens_.fail_next(fmt::format("'{}'", name));
  }

  void read_material() { read_material(false); }
  void read_mirror() { read_material(true); }
  void read_material(bool mirror) {
    Material m;
    m.mirror = mirror;
    m.name = tokens_.take_word("a name");
    take_name("reflect");
    m.reflectance = tokens_.take_rgb("a reflectance");
    if (!mirror && tokens_.take_if("emit")) m.emission = tokens_.take_rgb("an emission");
    tokens_.end_line();
    add_material(tokens_, tokens_.line(), m, room_.materials);
  }

  int take_divisions(std::string_view what) { return tokens_.take_count(what, 1, MAX_DIVISIONS); }

  void read_quad() { read_face(4); }
  void read_polygon() { read_face({}); }
  // A face of so many corners; of as many as the line has, if it is not said.
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
      face.across = corners ? take_divisions("patches across it") : face.along;
    }
    face.two_sided = tokens_.take_if("two-sided");
    if (tokens_.continues())
      tokens_.fail_next("'divide', then 'two-sided', or the end of the line");
    add_face(tokens_, tokens_.line(), std::move(face), room_);
  }

  // Six quads whose fronts are outside, or inside.
  void read_box() {
    const int line = tokens_.line();
    Face face;
    face.material = take_material(tokens_, room_, "lines above");
    const Vec ends[] = {tokens_.take_vec("the least corner"),
                        tokens_.take_vec("the greatest corner")};
    for (int axis = 0; axis < 3; ++axis)
      if (!(ends[0][axis] < ends[1][axis]))
        tokens_.fail(
            line, fmt::format("found a box from {} to {} along {}, expected the least corner first",
                              ends[0][axis], ends[1][axis], "xyz"[axis]));
    if (tokens_.take_if("divide"))
      face.along = face.across = take_divisions("patches along every edge");
    const bool inside = tokens_.take_if("inside");
    if (tokens_.continues()) tokens_.fail_next("'divide', then 'inside', or the end of the line");
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
                   fmt::format("found a second view, expected one, that of line {}", view_line_));
    view_line_ = line;
    renderer::View view;
    take_name("from");
    view.from = tokens_.take_vec("from");
    take_name("at");
    view.at = tokens_.take_vec("at");
    take_name("up");
    view.up = tokens_.take_vec("up");
    take_name("angle");
    view.angle = tokens_.take_number("the angle of the picture's height in degrees");
    take_name("size");
    view.width = tokens_.take_count("the picture's width", 1, renderer::MAX_SIDE);
    view.height = tokens_.take_count("the picture's height", 1, renderer::MAX_SIDE);
    tokens_.end_line();
    tokens_.at_line(line, [&] { room_.view = check_view(view); });
  }

  Tokens tokens_;
  Room room_;
  int view_line_ = 0;
  std::vector<int> crease_lines_;  // by crease
};

}  // namespace

Room read_room(std::istream& in, const std::string& name) { return Reader(in, name).read(); }

}  // namespace radiosity

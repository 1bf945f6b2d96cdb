#include "renderer/radiosity/files/obj_room.hpp"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <optional>
#include <sstream>

#include "base/whole_file.hpp"
#include "renderer/radiosity/files/parts.hpp"
#include "renderer/radiosity/room/check.hpp"
#include "renderer/scene/bounds.hpp"

// Not by tinyobjloader: version 2.0.0 reads "nan" as 0 and passes over what it does not know,
// without a word and without a line.

namespace radiosity {

namespace {

// A material of an MTL file; its Ks counts if it turns out to be a mirror.
struct Draft {
  Material material;
  Rgb specular;
  int line;
};

void read_mtl_statement(Tokens& tokens, std::vector<Draft>& drafts) {
  constexpr int MIRROR = 3, MAX_ILLUM = 10;
  const std::string name = tokens.take();
  if (name == "newmtl") {
    drafts.push_back({{}, {}, tokens.line()});
    drafts.back().material.name = tokens.take_word("a name");
    return tokens.end_line();
  }
  const bool known = name == "Kd" || name == "Ks" || name == "Ke" || name == "illum";
  if (!known) return tokens.skip_line();
  if (drafts.empty())
    tokens.fail(tokens.line(), fmt::format("found '{}', expected 'newmtl' before it", name));
  Draft& draft = drafts.back();
  if (name == "illum")
    draft.material.mirror = tokens.take_count("illum", 0, MAX_ILLUM) == MIRROR;
  else if (name == "Kd")
    draft.material.reflectance = tokens.take_rgb(name);
  else if (name == "Ks")
    draft.specular = tokens.take_rgb(name);
  else
    draft.material.emission = tokens.take_rgb(name);
  tokens.end_line();
}

void load_mtl(const std::string& path, std::vector<Material>& materials) {
  std::istringstream in(base::read_text(path));
  Tokens tokens(in, path);
  std::vector<Draft> drafts;
  while (tokens.begin_line()) read_mtl_statement(tokens, drafts);
  for (Draft& draft : drafts) {
    if (draft.material.mirror) draft.material.reflectance = draft.specular;
    add_material(tokens, draft.line, draft.material, materials);
  }
}

class Reader {
 public:
  Reader(std::istream& in, const std::string& path) : tokens_(in, path) {}

  Room read() {
    while (tokens_.begin_line()) read_statement();
    check_light(room_, tokens_.name());
    return std::move(room_);
  }

 private:
  void read_statement() {
    using Read = void (Reader::*)();
    constexpr std::pair<std::string_view, Read> STATEMENTS[] = {{"v", &Reader::read_point},
                                                                {"vn", &Reader::read_normal},
                                                                {"f", &Reader::read_face},
                                                                {"usemtl", &Reader::use_material},
                                                                {"mtllib", &Reader::read_library},
                                                                {"vt", &Reader::skip},
                                                                {"g", &Reader::skip},
                                                                {"o", &Reader::skip},
                                                                {"s", &Reader::skip}};
    (this->*tokens_.take_choice(STATEMENTS,
                                "a statement: v, vt, vn, f, g, o, s, usemtl or mtllib"))();
  }

  void skip() { tokens_.skip_line(); }

  void read_point() {
    points_.push_back(tokens_.take_vec("a vertex"));
    skip();  // a weight or a colour
  }

  void read_normal() {
    normals_.push_back(tokens_.take_vec("a normal"));
    tokens_.end_line();
  }

  void use_material() {
    material_ = take_material(tokens_, room_, "files above");
    skip();
  }

  void read_library() {
    do {
      const auto folder = std::filesystem::path(tokens_.name()).parent_path();
      const std::string path = (folder / tokens_.take_word("a file")).string();
      load_mtl(path, room_.materials);
      room_.libraries.push_back(path);
    } while (!tokens_.peek().empty());
  }

  // Corners are v, v/vt, v//vn or v/vt/vn.
  void read_face() {
    const int line = tokens_.line();
    if (!material_) tokens_.fail(line, "found 'f', expected 'usemtl' before the first face");
    Face face;
    face.material = *material_;
    while (!tokens_.peek().empty()) {
      const std::string_view word = tokens_.peek();
      const std::size_t slash = word.find('/'),
                        second = word.find('/', std::min(slash, word.size() - 1) + 1);
      face.corners.push_back(find(points_, word.substr(0, slash), "vertex (v)"));
      if (slash != word.npos && second != word.npos)
        face.normals.push_back(find(normals_, word.substr(second + 1), "normal (vn)"));
      tokens_.take();
    }
    add_face(tokens_, line, std::move(face), room_);
  }

  // What a corner refers to: counted from 1, or backwards from -1.
  const Vec& find(const std::vector<Vec>& list, std::string_view text, const char* what) {
    const auto count = static_cast<long long>(list.size());
    long long n = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
    if (error != std::errc{} || end != text.data() + text.size() || n == 0 || n > count ||
        n < -count)
      tokens_.fail_next(
          fmt::format("the number of a {} in each corner, of the {} so far, 1 the first and "
                      "-1 the last",
                      what, count));
    return list[static_cast<std::size_t>(n > 0 ? n - 1 : count + n)];
  }

  Tokens tokens_;
  Room room_;
  std::vector<Vec> points_, normals_;
  std::optional<std::uint32_t> material_;  // of the faces to come
};

// The bounds just fit into the picture, up is y.
renderer::View make_view(const Room& room) {
  renderer::Bounds bounds;
  for (const Face& face : room.faces)
    for (const Vec& c : face.corners) bounds = renderer::join(bounds, c);
  renderer::View view;
  const double sine = 0.38268343236508977;  // of half the view's 45 degrees
  view.at = 0.5 * (bounds.lo + bounds.hi);
  view.from = view.at + (0.5 / sine) * (bounds.hi - bounds.lo);
  return check_view(view);
}

}  // namespace

Room load_obj_room(const std::string& path) {
  std::istringstream in(base::read_text(path));
  Room room = Reader(in, path).read();
  room.view = make_view(room);
  return room;
}

}  // namespace radiosity

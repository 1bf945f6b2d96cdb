// Not by tinyobjloader: of 2.0.0 it reads "nan" as 0 and passes over what it does not know, without
// a word and without a line.

#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <optional>

#include "renderer/files/nff_statements.hpp"
#include "renderer/radiosity/files/files.hpp"
#include "renderer/radiosity/files/load_room.hpp"
#include "renderer/radiosity/files/mtl.hpp"
#include "renderer/radiosity/files/statement.hpp"
#include "renderer/radiosity/room/check.hpp"
#include "renderer/scene/bounds.hpp"

namespace radiosity {

namespace {

struct Reader {
  renderer::Tokens tokens;
  std::string path;
  Room room{};
  std::vector<Vec> points{}, normals{};
  std::optional<std::uint32_t> material{};  // of the faces to come
};

void read_library(Reader& r, Statement& s) {
  do {
    const std::filesystem::path folder = std::filesystem::path(r.path).parent_path();
    const std::string path = (folder / s.take_word("a file")).string();
    std::ifstream in = open_file(path, "an MTL file");
    read_mtl(in, path, r.room.materials);
    r.room.libraries.push_back(path);
  } while (!s.peek().empty());
}

void use_material(Reader& r, Statement& s) {
  const std::string_view name = s.peek();
  std::string known;
  for (std::uint32_t i = 0; i < r.room.materials.size(); ++i) {
    if (r.room.materials[i].name == name) {
      r.material = i;
      s.skip();
      return;
    }
    known += (i == 0 ? "" : ", ") + r.room.materials[i].name;
  }
  s.fail_next(fmt::format("a material of the files above: {}", known.empty() ? "none yet" : known));
}

// Of a corner's reference: counted from 1, or backwards from -1.
const Vec& find(const std::vector<Vec>& list, std::string_view text, const char* what,
                Statement& s) {
  const auto count = static_cast<long long>(list.size());
  long long n = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
  if (error != std::errc{} || end != text.data() + text.size() || n == 0 || n > count || n < -count)
    s.fail_next(
        fmt::format("the number of a {} in each corner, of the {} so far, 1 the first and "
                    "-1 the last",
                    what, count));
  return list[static_cast<std::size_t>(n > 0 ? n - 1 : count + n)];
}

// Corners are v, v/vt, v//vn or v/vt/vn.
void read_face(Reader& r, Statement& s) {
  if (!r.material) s.fail("found 'f', expected 'usemtl' before the first face");
  Face face;
  face.material = *r.material;
  while (!s.peek().empty()) {
    const std::string_view word = s.peek();
    const std::size_t slash = word.find('/'),
                      second = word.find('/', std::min(slash, word.size() - 1) + 1);
    face.corners.push_back(find(r.points, word.substr(0, slash), "vertex (v)", s));
    if (slash != word.npos && second != word.npos)
      face.normals.push_back(find(r.normals, word.substr(second + 1), "normal (vn)", s));
    s.take_word("");
  }
  face.where = fmt::format("{}:{}", r.path, s.line());
  at_line(r.tokens, s.line(), [&] { check_face(face, r.room.materials.size()); });
  r.room.faces.push_back(std::move(face));
}

void read_statement(Reader& r) {
  constexpr std::string_view NAMES[] = {"v", "vn", "f", "usemtl", "mtllib", "vt", "g", "o", "s"};
  const auto* name = std::find(std::begin(NAMES), std::end(NAMES), r.tokens.peek());
  if (name == std::end(NAMES))
    r.tokens.fail_next("a statement: v, vt, vn, f, g, o, s, usemtl or mtllib");
  r.tokens.take();
  Statement s(r.tokens);
  switch (name - NAMES) {
    case 0:
      r.points.push_back(s.take_vec("a vertex"));
      return s.skip();  // a weight or a colour
    case 1:
      r.normals.push_back(s.take_vec("a normal"));
      return s.end();
    case 2:
      return read_face(r, s);
    case 3:
      return use_material(r, s);
    case 4:
      return read_library(r, s);
    default:
      return s.skip();
  }
}

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
  std::ifstream in = open_file(path, "an OBJ file");
  Reader r{renderer::Tokens(in, path), path};
  while (!r.tokens.peek().empty()) read_statement(r);
  check_light(r.room, path);
  r.room.view = make_view(r.room);
  return std::move(r.room);
}

}  // namespace radiosity

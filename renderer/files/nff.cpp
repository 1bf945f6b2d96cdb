#include "renderer/files/nff.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <system_error>

#include "base/errors.hpp"
#include "renderer/files/nff_statements.hpp"

namespace renderer {

namespace {

constexpr int MAX_LIGHTS = 65535;

struct Reader {
  Tokens tokens;
  Scene scene{};
  int view_line = 0;
  std::vector<bool> light_has_colour{};
};

void read_light(Reader& r) {
  if (r.scene.lights.size() >= MAX_LIGHTS)
    r.tokens.fail(r.tokens.line(),
                  fmt::format("found more lights, expected at most {}", MAX_LIGHTS));
  Light light{r.tokens.take_vec("the light's position")};
  const bool coloured = r.tokens.continues();
  if (coloured) light.intensity = r.tokens.take_rgb("the light's colour");
  r.light_has_colour.push_back(coloured);
  r.scene.lights.push_back(light);
}

void read_view(Reader& r) {
  if (r.view_line != 0)
    r.tokens.fail(r.tokens.line(),
                  fmt::format("found a second 'v', expected one, that of line {}", r.view_line));
  r.view_line = r.tokens.line();
  r.scene.view = take_view(r.tokens);
}

void read_polygon(Reader& r, bool with_normals) {
  const int line = r.tokens.line();
  const Outline outline = take_outline(r.tokens, with_normals);
  at_line(r.tokens, line, [&] {
    if (with_normals)
      add_patch(r.scene, outline.corners, outline.normals);
    else
      add_polygon(r.scene, outline.corners);
  });
}

void read_cone(Reader& r) {
  const int line = r.tokens.line();
  const Vec base = r.tokens.take_vec("the base");
  const double base_radius = r.tokens.take_number("the base's radius", 0, MAX_NUMBER);
  const Vec apex = r.tokens.take_vec("the apex");
  const double apex_radius = r.tokens.take_number("the apex's radius", 0, MAX_NUMBER);
  at_line(r.tokens, line, [&] { add_cone(r.scene, base, base_radius, apex, apex_radius); });
}

void read_sphere(Reader& r) {
  const int line = r.tokens.line();
  const Vec centre = r.tokens.take_vec("the centre");
  const double radius = r.tokens.take_number("the radius", 0, MAX_NUMBER);
  at_line(r.tokens, line, [&] { add_sphere(r.scene, centre, radius); });
}

void read_statement(Reader& r) {
  constexpr std::string_view NAMES[] = {"v", "b", "l", "f", "s", "p", "pp", "c"};
  const auto* name = std::find(std::begin(NAMES), std::end(NAMES), r.tokens.peek());
  if (name == std::end(NAMES)) r.tokens.fail_next("a statement: v, b, l, f, s, p, pp or c");
  r.tokens.take();
  const int line = r.tokens.line();
  if (name - NAMES >= 4 && r.scene.surfaces.empty())
    r.tokens.fail(line, fmt::format("found '{}', expected a surface ('f') before the first "
                                    "primitive",
                                    *name));
  switch (name - NAMES) {
    case 0:
      return read_view(r);
    case 1:
      r.scene.background = r.tokens.take_rgb("the background");
      return;
    case 2:
      return read_light(r);
    case 3:
      r.scene.surfaces.push_back(take_surface(r.tokens));
      return;
    case 4:
      return read_sphere(r);
    case 5:
      return read_polygon(r, false);
    case 6:
      return read_polygon(r, true);
    case 7:
      return read_cone(r);
  }
}

}  // namespace

Scene parse_nff(std::istream& in, const std::string& name) {
  Reader r{Tokens(in, name)};
  while (!r.tokens.peek().empty()) read_statement(r);
  if (r.view_line == 0) r.tokens.fail_next("a view ('v')");
  // SPD: all lights together have the same energy, however many there are.
  const double share =
      1 / std::sqrt(static_cast<double>(std::max<std::size_t>(1, r.scene.lights.size())));
  for (std::size_t i = 0; i < r.scene.lights.size(); ++i)
    if (!r.light_has_colour[i]) r.scene.lights[i].intensity = {share, share, share};
  at_line(r.tokens, r.view_line, [&] { finish(r.scene); });
  return std::move(r.scene);
}

Scene load_nff(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw base::BadInput(fmt::format("{}: found a directory, expected an NFF file", path));
  std::ifstream in(path);
  if (!in)
    throw base::BadInput(
        fmt::format("{}: cannot be read: {}", path, std::generic_category().message(errno)));
  return parse_nff(in, path);
}

}  // namespace renderer

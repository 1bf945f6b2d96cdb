#include "renderer/nff.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <system_error>

#include "renderer/tokens.hpp"

namespace renderer {

namespace {

constexpr int MAX_VERTICES = 1 << 24, MAX_LIGHTS = 65535, MAX_RESOLUTION = 65536;
constexpr double MAX_SHINE = 1e9, MAX_IOR = 1e6;

struct Reader {
  Tokens tokens;
  Scene scene{};
  int view_line = 0;
  std::vector<bool> light_has_colour{};
  std::vector<Vec> corners{}, normals{};
};

// Whatever `action` finds wrong with a scene is wrong at `line`.
template <typename Action>
void at_line(const Reader& r, int line, const Action& action) {
  try {
    action();
  } catch (const BadScene& bad) {
    r.tokens.fail(line, bad.what());
  }
}

void read_view(Reader& r) {
  if (r.view_line != 0)
    r.tokens.fail(r.tokens.line(),
                  fmt::format("found a second 'v', expected one, that of line {}", r.view_line));
  r.view_line = r.tokens.line();
  View& view = r.scene.view;
  constexpr std::string_view NAMES[] = {"from", "at", "up", "angle", "hither", "resolution"};
  bool seen[6] = {};
  for (;;) {
    const auto* name = std::find(std::begin(NAMES), std::end(NAMES), r.tokens.peek());
    if (name == std::end(NAMES)) break;
    bool& again = seen[name - NAMES];
    if (again) r.tokens.fail_next("each of the view's settings once");
    again = true;
    r.tokens.take();
    switch (name - NAMES) {
      case 0:
        view.from = r.tokens.take_vec("from");
        break;
      case 1:
        view.at = r.tokens.take_vec("at");
        break;
      case 2:
        view.up = r.tokens.take_vec("up");
        break;
      case 3:
        view.angle = r.tokens.take_number("angle", 0, 180);
        break;
      case 4:
        view.hither = r.tokens.take_number("hither", 0, MAX_NUMBER);
        break;
      case 5:
        view.width = r.tokens.take_count("the resolution's width", 1, MAX_RESOLUTION);
        view.height = r.tokens.take_count("the resolution's height", 1, MAX_RESOLUTION);
        break;
    }
  }
  for (int i = 0; i < 4; ++i)  // hither and resolution have defaults
    if (!seen[i]) r.tokens.fail_next(fmt::format("the view's '{}'", NAMES[i]));
}

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

void read_surface(Reader& r) {
  Surface s;
  s.colour = r.tokens.take_rgb("the surface's colour");
  s.kd = r.tokens.take_number("Kd", 0, 1);
  s.ks = r.tokens.take_number("Ks", 0, 1);
  s.shine = r.tokens.take_number("Shine", 0, MAX_SHINE);
  s.t = r.tokens.take_number("T", 0, 1);
  const double ior = r.tokens.take_number("the index of refraction", 0, MAX_IOR);
  if (ior > 0)
    s.ior = ior;
  else if (s.t > 0)  // files give 0 to what is opaque
    r.tokens.fail(r.tokens.line(),
                  "found an index of refraction of 0, expected one > 0 where T > 0");
  r.scene.surfaces.push_back(s);
}

void read_polygon(Reader& r, bool with_normals) {
  const int line = r.tokens.line();
  const int count = r.tokens.take_count("the number of vertices", 3, MAX_VERTICES);
  r.corners.clear();
  r.normals.clear();
  for (int i = 0; i < count; ++i) {
    r.corners.push_back(r.tokens.take_vec("a vertex"));
    if (with_normals) r.normals.push_back(r.tokens.take_vec("a normal"));
  }
  at_line(r, line, [&] {
    if (with_normals)
      add_patch(r.scene, r.corners, r.normals);
    else
      add_polygon(r.scene, r.corners);
  });
}

void read_cone(Reader& r) {
  const int line = r.tokens.line();
  const Vec base = r.tokens.take_vec("the base");
  const double base_radius = r.tokens.take_number("the base's radius", 0, MAX_NUMBER);
  const Vec apex = r.tokens.take_vec("the apex");
  const double apex_radius = r.tokens.take_number("the apex's radius", 0, MAX_NUMBER);
  at_line(r, line, [&] { add_cone(r.scene, base, base_radius, apex, apex_radius); });
}

void read_sphere(Reader& r) {
  const int line = r.tokens.line();
  const Vec centre = r.tokens.take_vec("the centre");
  const double radius = r.tokens.take_number("the radius", 0, MAX_NUMBER);
  at_line(r, line, [&] { add_sphere(r.scene, centre, radius); });
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
      return read_surface(r);
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
  at_line(r, r.view_line, [&] { finish(r.scene); });
  return std::move(r.scene);
}

Scene load_nff(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw BadScene(fmt::format("{}: found a directory, expected an NFF file", path));
  std::ifstream in(path);
  if (!in)
    throw BadScene(
        fmt::format("{}: cannot be read: {}", path, std::generic_category().message(errno)));
  return parse_nff(in, path);
}

}  // namespace renderer

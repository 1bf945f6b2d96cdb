#include "renderer/files/nff_statements.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace renderer {

namespace {

constexpr int MAX_VERTICES = 1 << 24, MAX_RESOLUTION = 65536;
constexpr double MAX_SHINE = 1e9, MAX_IOR = 1e6;

}  // namespace

View take_view(Tokens& tokens) {
  View view;
  constexpr std::string_view NAMES[] = {"from", "at", "up", "angle", "hither", "resolution"};
  bool seen[6] = {};
  for (;;) {
    const auto* name = std::find(std::begin(NAMES), std::end(NAMES), tokens.peek());
    if (name == std::end(NAMES)) break;
    bool& again = seen[name - NAMES];
    if (again) tokens.fail_next("each of the view's settings once");
    again = true;
    tokens.take();
    switch (name - NAMES) {
      case 0:
        view.from = tokens.take_vec("from");
        break;
      case 1:
        view.at = tokens.take_vec("at");
        break;
      case 2:
        view.up = tokens.take_vec("up");
        break;
      case 3:
        view.angle = tokens.take_number("angle", 0, 180);
        break;
      case 4:
        view.hither = tokens.take_number("hither", 0, MAX_NUMBER);
        break;
      case 5:
        view.width = tokens.take_count("the resolution's width", 1, MAX_RESOLUTION);
        view.height = tokens.take_count("the resolution's height", 1, MAX_RESOLUTION);
        break;
    }
  }
  for (int i = 0; i < 4; ++i)  // hither and resolution have defaults
    if (!seen[i]) tokens.fail_next(fmt::format("the view's '{}'", NAMES[i]));
  return view;
}

Surface take_surface(Tokens& tokens) {
  Surface s;
  s.colour = tokens.take_rgb("the surface's colour");
  s.kd = tokens.take_number("Kd", 0, 1);
  s.ks = tokens.take_number("Ks", 0, 1);
  s.shine = tokens.take_number("Shine", 0, MAX_SHINE);
  s.t = tokens.take_number("T", 0, 1);
  const double ior = tokens.take_number("the index of refraction", 0, MAX_IOR);
  if (ior > 0)
    s.ior = ior;
  else if (s.t > 0)  // files give 0 to what is opaque
    tokens.fail(tokens.line(), "found an index of refraction of 0, expected one > 0 where T > 0");
  return s;
}

Outline take_outline(Tokens& tokens, bool with_normals) {
  const int count = tokens.take_count("the number of vertices", 3, MAX_VERTICES);
  Outline outline;
  for (int i = 0; i < count; ++i) {
    outline.corners.push_back(tokens.take_vec("a vertex"));
    if (with_normals) outline.normals.push_back(tokens.take_vec("a normal"));
  }
  return outline;
}

}  // namespace renderer

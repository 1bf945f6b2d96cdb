#include "renderer/scene/generators.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>

#include "base/errors.hpp"

namespace renderer {

namespace {

// Directions from a sphere that points towards +z to its nine children: six around its equator, at
// 15 degrees from the axes, and three above.
std::array<Vec, 9> make_directions() {
  const double s = (std::sqrt(6.0) - std::sqrt(2.0)) / 4, c = (std::sqrt(6.0) + std::sqrt(2.0)) / 4;
  const double h = std::sqrt(0.5), low = std::sqrt(1 / 3.0), high = std::sqrt(2 / 3.0);
  return {{{low * h, low * h, high},
           {c, s, 0},
           {s, c, 0},
           {-low * c, low * s, high},
           {-h, h, 0},
           {-c, -s, 0},
           {low * s, -low * c, high},
           {-s, -c, 0},
           {h, -h, 0}}};
}

// Rotates `v` by the shortest rotation from +z to the unit vector `to`. Uses no sines, so that all
// hosts get the same bits.
Vec turn(const Vec& v, const Vec& to) {
  const double d = 1 + to.z;
  if (d < 1e-12) return {-v.x, v.y, -v.z};  // rotates by half a turn about y
  const double xy = to.x * to.y / d;
  return {(1 - to.x * to.x / d) * v.x - xy * v.y + to.x * v.z,
          -xy * v.x + (1 - to.y * to.y / d) * v.y + to.y * v.z,
          -to.x * v.x - to.y * v.y + to.z * v.z};
}

struct Flake {
  Vec centre;
  double radius;
  Vec up;  // unit vector away from the parent's centre
};

std::vector<Flake> make_sphereflake(std::size_t n) {
  const std::array<Vec, 9> directions = make_directions();
  std::vector<Flake> flakes = {{{0, 0, 0}, 0.5, {0, 0, 1}}};
  flakes.reserve(n);
  for (std::size_t parent = 0; flakes.size() < n; ++parent) {
    const Flake p = flakes[parent];
    for (const Vec& d : directions) {
      if (flakes.size() == n) break;
      const Vec up = turn(d, p.up);
      flakes.push_back({p.centre + (4 * p.radius / 3) * up, p.radius / 3, normalize(up)});
    }
  }
  return flakes;
}

// Rounds to six significant digits, as the SPD's own program does. Rays between touching spheres
// depend on this rounding; without it, the numbers of rays would differ from those of the SPD.
double round_to_six_digits(double value) {
  char text[32];
  const char* end = fmt::format_to(text, "{:.6g}", value);
  std::from_chars(text, end, value);
  return value;
}

// Adds a rectangle to the room. z points up; lengths are in metres.
void add_rectangle(Scene& scene, const Vec& corner, const Vec& u, const Vec& v) {
  const Vec corners[] = {corner, corner + u, corner + u + v, corner + v};
  add_polygon(scene, corners);
}

// Adds a block, given by two opposite corners. Its six faces point outwards.
void add_block(Scene& scene, const Vec& lo, const Vec& hi) {
  const Vec x{hi.x - lo.x, 0, 0}, y{0, hi.y - lo.y, 0}, z{0, 0, hi.z - lo.z};
  add_rectangle(scene, lo, y, x);
  add_rectangle(scene, lo, x, z);
  add_rectangle(scene, lo, z, y);
  add_rectangle(scene, hi, -x, -y);
  add_rectangle(scene, hi, -z, -x);
  add_rectangle(scene, hi, -y, -z);
}

constexpr double ROOM_X = 5, ROOM_Y = 5, ROOM_Z = 2.7;

// Adds a grid of `lights` point lights below the ceiling, row by row.
void add_room_lights(Scene& scene, int lights) {
  const int columns = static_cast<int>(std::ceil(std::sqrt(lights)));
  const int rows = (lights + columns - 1) / columns;
  const double intensity = 1.2 / lights;
  for (int i = 0; i < lights; ++i)
    scene.lights.push_back({{ROOM_X * (i % columns + 0.5) / columns,
                             ROOM_Y * (i / columns + 0.5) / rows, ROOM_Z - 0.2},
                            {intensity, intensity, intensity}});
}

// Adds the walls of the room. The back wall leaves an opening for the window.
void add_room_walls(Scene& scene, const Vec& window_lo, const Vec& window_hi) {
  const Vec x{ROOM_X, 0, 0}, y{0, ROOM_Y, 0}, z{0, 0, ROOM_Z}, back = y;
  add_rectangle(scene, {0, 0, 0}, z, x);
  add_rectangle(scene, {0, 0, 0}, y, z);
  add_rectangle(scene, x, z, y);
  add_rectangle(scene, z, y, x);
  const double height = window_hi.z - window_lo.z;
  add_rectangle(scene, back, x, {0, 0, window_lo.z});
  add_rectangle(scene, back + Vec{0, 0, window_hi.z}, x, {0, 0, ROOM_Z - window_hi.z});
  add_rectangle(scene, back + Vec{0, 0, window_lo.z}, {window_lo.x, 0, 0}, {0, 0, height});
  add_rectangle(scene, back + Vec{window_hi.x, 0, window_lo.z}, {ROOM_X - window_hi.x, 0, 0},
                {0, 0, height});
}

// Adds the legs of the table, and the rails between neighbouring legs under the table top.
void add_table_frame(Scene& scene, const Vec& lo, const Vec& hi) {
  constexpr double RADIUS = 0.03;
  const Vec feet[] = {{lo.x, lo.y, 0}, {hi.x, lo.y, 0}, {hi.x, hi.y, 0}, {lo.x, hi.y, 0}};
  for (int i = 0; i < 4; ++i) {
    const Vec foot = feet[i], top = foot + Vec{0, 0, lo.z}, rail{0, 0, -RADIUS};
    add_cone(scene, foot, RADIUS, top, RADIUS);
    add_cone(scene, top + rail, RADIUS, feet[(i + 1) % 4] + Vec{0, 0, lo.z} + rail, RADIUS);
  }
}

}  // namespace

Scene make_spheres(int n) {
  if (n < 1 || n > MAX_SPHERES)
    throw base::BadInput(
        fmt::format("found spheres:{}, expected spheres:N with N from 1 to {}", n, MAX_SPHERES));
  Scene scene;
  scene.view = {.from = {2.1, 1.3, 1.7},
                .at = {0, 0, 0},
                .up = {0, 0, 1},
                .angle = 45,
                .hither = 0.01,
                .width = 512,
                .height = 512};
  scene.background = {0.078, 0.361, 0.753};
  const double intensity = 1 / std::sqrt(3.0);
  for (const Vec& at : {Vec{4, 3, 2}, Vec{1, -4, 4}, Vec{-3, 1, 5}})
    scene.lights.push_back({at, {intensity, intensity, intensity}});

  scene.surfaces.push_back({.colour = {1, 0.75, 0.33}, .kd = 0.8, .ks = 0, .shine = 100000});
  const Vec floor[] = {{12, 12, -0.5}, {-12, 12, -0.5}, {-12, -12, -0.5}, {12, -12, -0.5}};
  add_polygon(scene, floor);
  scene.surfaces.push_back({.colour = {1, 0.9, 0.7}, .kd = 0.5, .ks = 0.5, .shine = 3.0827});
  const auto six = round_to_six_digits;
  for (const auto& [centre, radius, up] : make_sphereflake(static_cast<std::size_t>(n)))
    add_sphere(scene, {six(centre.x), six(centre.y), six(centre.z)}, six(radius));
  finish(scene);
  return scene;
}

Scene make_room(int lights) {
  if (lights < 1 || lights > MAX_ROOM_LIGHTS)
    throw base::BadInput(
        fmt::format("found room:{}, expected room:L with L from 1 to {}", lights, MAX_ROOM_LIGHTS));
  Scene scene;
  scene.view = {.from = {2.5, 0.2, 1.5},
                .at = {2.5, 4, 0.95},
                .up = {0, 0, 1},
                .angle = 55,
                .width = 512,
                .height = 512};
  scene.background = {0.55, 0.7, 0.9};
  add_room_lights(scene, lights);

  const Vec window_lo{1.9, ROOM_Y - 0.01, 1.0}, window_hi{3.1, ROOM_Y + 0.01, 2.1};
  scene.surfaces.push_back({.colour = {0.9, 0.87, 0.8}, .kd = 0.8, .ks = 0.003, .shine = 2});
  add_room_walls(scene, window_lo, window_hi);
  scene.surfaces.push_back({.colour = {0.65, 0.45, 0.3}, .kd = 0.7, .ks = 0.2, .shine = 20});
  add_rectangle(scene, {0, 0, 0}, {ROOM_X, 0, 0}, {0, ROOM_Y, 0});

  scene.surfaces.push_back(
      {.colour = {0.8, 1, 0.9}, .kd = 0.1, .ks = 0.2, .shine = 100, .t = 0.7, .ior = 1.5});
  add_block(scene, window_lo, window_hi);
  const Vec top_lo{1.8, 2.0, 0.72}, top_hi{3.2, 2.9, 0.74};
  add_block(scene, top_lo, top_hi);
  scene.surfaces.push_back({.colour = {0.8, 0.8, 0.85}, .kd = 0.3, .ks = 0.6, .shine = 50});
  const Vec inset{0.1, 0.1, 0};
  add_table_frame(scene, top_lo + inset, top_hi - inset);
  finish(scene);
  return scene;
}

}  // namespace renderer

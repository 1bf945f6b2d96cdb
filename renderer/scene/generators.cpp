#include "renderer/scene/generators.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>

#include "base/errors.hpp"

namespace renderer {

namespace {

// Directions to the nine children of a sphere that was carried towards +z itself: six around its
// equator, 15 degrees off the axes, and three above.
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

// `v` turned as +z turns to the unit vector `to`, about the axis across both; no sines, so that
// every machine gets the same bits.
Vec turn(const Vec& v, const Vec& to) {
  const double d = 1 + to.z;
  if (d < 1e-12) return {-v.x, v.y, -v.z};  // half a turn about y
  const double xy = to.x * to.y / d;
  return {(1 - to.x * to.x / d) * v.x - xy * v.y + to.x * v.z,
          -xy * v.x + (1 - to.y * to.y / d) * v.y + to.y * v.z,
          -to.x * v.x - to.y * v.y + to.z * v.z};
}

struct Flake {
  Vec centre;
  double radius;
  Vec up;  // unit, from its parent's centre
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

// Rounds to six significant digits, as the SPD's own program writes its numbers. Where spheres
// touch, the paths of rays depend on it: only so are ray counts those of the SPD's files.
double round_to_six_digits(double value) {
  char text[32];
  const char* end = fmt::format_to(text, "{:.6g}", value);
  std::from_chars(text, end, value);
  return value;
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

}  // namespace renderer

#pragma once
// Random input for the renderer's tests, determined by a seed.

#include <array>
#include <numbers>
#include <sstream>

#include "base/errors.hpp"
#include "renderer/files/load_scene.hpp"
#include "renderer/trace/render.hpp"
#include "renderer/trace/shade.hpp"

namespace renderer::test {

/// A counter-based generator: number n depends only on the seed and on n (SplitMix64).
struct Random {
  std::uint64_t seed = 0, n = 0;

  std::uint64_t bits() {
    std::uint64_t z = seed * 0xD1B54A32D192ED03 + ++n * 0x9E3779B97F4A7C15;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
    return z ^ (z >> 31);
  }
  double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  double range(double lo, double hi) { return lo + (hi - lo) * unit(); }
  int below(int n_) { return static_cast<int>(bits() % static_cast<std::uint64_t>(n_)); }
  Vec point(double extent) {
    const double x = range(-extent, extent), y = range(-extent, extent);
    return {x, y, range(-extent, extent)};
  }
  Vec direction() {
    for (;;) {
      const Vec v = point(1);
      if (length(v) > 0.1 && length(v) < 1) return normalize(v);
    }
  }
  Rgb colour() {
    const double r = unit(), g = unit();
    return {r, g, unit()};
  }
};

inline Scene parse(const std::string& text) { return parse_scene(text, "test.nff"); }

/// Two unit vectors that are orthogonal to `n` and to each other.
inline std::array<Vec, 2> make_plane(const Vec& n) {
  const Vec u = normalize(cross(n, std::abs(n.x) < 0.5 ? Vec{1, 0, 0} : Vec{0, 1, 0}));
  return {u, cross(n, u)};
}

/// A star-shaped polygon around `centre` in a random plane. It is mostly concave.
inline std::vector<Vec> make_star(Random& random, const Vec& centre, double size) {
  const auto [u, v] = make_plane(random.direction());
  const int corners = 3 + random.below(6);
  std::vector<Vec> star;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners, r = size * random.range(0.3, 1);
    star.push_back(centre + r * std::cos(angle) * u + r * std::sin(angle) * v);
  }
  return star;
}

/// A scene with `objects` objects of all four kinds, some of them mirrors or glass, and with
/// `lights` lights.
inline Scene make_random_scene(std::uint64_t seed, int objects, int lights = 2) {
  Random random{seed};
  Scene scene;
  scene.background = random.colour();
  scene.view.from = {0.3, 0.2, 6};
  for (int i = 0; i < lights; ++i) scene.lights.push_back({random.point(5), random.colour()});
  for (int i = 0; i < objects; ++i) {
    scene.surfaces.push_back({random.colour(), random.unit(), random.below(2) * random.unit(),
                              random.range(1, 50), random.below(2) * random.unit(),
                              random.range(1, 2)});
    const Vec at = random.point(2);
    const double size = random.range(0.2, 0.9);
    switch (random.below(4)) {
      case 0:
        add_sphere(scene, at, size);
        break;
      case 1:
        add_polygon(scene, make_star(random, at, size));
        break;
      case 2: {
        const std::vector<Vec> corners = make_star(random, at, size);
        std::vector<Vec> normals;
        for (const Vec& c : corners) normals.push_back(c - at + random.direction());
        add_patch(scene, corners, normals);
        break;
      }
      case 3:
        add_cone(scene, at, size / 2, at + size * random.direction(), random.unit());
        break;
    }
  }
  finish(scene);
  return scene;
}

inline Params make_params(int width, int height, int depth,
                          Traversal traversal = Traversal::nearest) {
  Params params;
  params.width = width;
  params.height = height;
  params.limits.depth = depth;
  params.traversal = traversal;
  return params;
}

}  // namespace renderer::test

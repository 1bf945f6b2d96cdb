#pragma once
// Scenes for the tests of several programs.
#include <random>

#include "renderer/files/load_scene.hpp"

namespace test {

/// Makes a scene with glass, a mirror, a floor and two lights, which together cause every kind of
/// ray.
inline renderer::Scene make_glass_scene() {
  return renderer::parse_scene(
      "v\nfrom 0 -4 1.5\nat 0 0 0.3\nup 0 0 1\nangle 40\nhither 0.01\nresolution 24 24\n"
      "b 0.2 0.4 0.7\nl 3 -4 5\nl -4 -2 3 0.5 0.4 0.3\n"
      "f 0.8 0.7 0.5 0.9 0 1 0 1\np 4\n-5 -5 -1\n5 -5 -1\n5 5 -1\n-5 5 -1\n"
      "f 0.9 0.9 1 0.1 0.3 20 0.6 1.5\ns -0.5 0 0.1 0.8\n"
      "f 1 0.5 0.3 0.4 0.5 8 0 1\ns 0.8 0.6 0 0.7\nc\n0.2 -1 -1 0.4\n0.2 -1 0 0.1\n",
      "glass");
}

/// Makes the scene of make_glass_scene() with a lens, area lights and rough surfaces.
inline renderer::Scene make_soft_scene() {
  renderer::Scene scene = make_glass_scene();
  scene.view.lens = {.aperture = 0.3, .focus = 4};
  scene.lights[0].shape = renderer::LightShape::rectangle;
  scene.lights[0].u = {1, 0, 0};
  scene.lights[0].v = {0, 0.5, 0.5};
  scene.lights[1].shape = renderer::LightShape::sphere;
  scene.lights[1].radius = 0.8;
  scene.surfaces[1].translucency = 0.2;
  scene.surfaces[2].gloss = 0.3;
  return scene;
}

/// Makes parameters with several samples per pixel. In half the cases, sampling is adaptive.
inline renderer::Sampling random_sampling(std::mt19937_64& random) {
  renderer::Sampling sampling;
  sampling.pixel_samples = 1 + static_cast<int>(random() % 7);
  if (random() % 2 == 0) {
    sampling.pixel_samples += renderer::FIRST_ROUND + static_cast<int>(random() % 20);
    sampling.adaptive = 0.02 * static_cast<double>(1 + random() % 4);
  }
  sampling.lens = static_cast<double>(random() % 3);
  sampling.seed = random() % 1000;
  return sampling;
}

}  // namespace test

// Tests that the mean of adaptive images over many seeds equals that of images with a fixed number
// of samples.
#include <gtest/gtest.h>

#include "tests/renderer/support.hpp"

namespace renderer::test {
namespace {

constexpr int SIDE = 16;  // width and height of the image in pixels

// A view from the origin along y. At the distance 100, a pixel has the size 1.
Scene make_view() {
  Scene scene;
  scene.view.from = {0, 0, 0};
  scene.view.at = {0, 1, 0};
  scene.view.up = {0, 0, 1};
  scene.view.angle = 2 * std::atan(0.5 * SIDE / 100) * 180 / std::numbers::pi;
  scene.surfaces.push_back({});
  return scene;
}

// Adds the half plane to the right of x, at the distance 100.
void add_half_plane(Scene& scene, double x) {
  add_polygon(scene,
              std::vector<Vec>{{x, 100, -500}, {999, 100, -500}, {999, 100, 500}, {x, 100, 500}});
}

// A half plane behind the plane in focus. The lens blurs its edge over 6.4 pixels.
Scene make_blurred_edge() {
  Scene scene = make_view();
  scene.view.lens = {.aperture = 6.4, .focus = 50};
  add_half_plane(scene, 4.3);
  return scene;
}

// A sphere in each pixel, which covers 1/20 of it.
Scene make_dots() {
  Scene scene = make_view();
  Random random{5};
  const auto place = [&] { return random.range(0.2, 0.8) - SIDE / 2; };
  for (int y = 0; y < SIDE; ++y)
    for (int x = 0; x < SIDE; ++x)
      add_sphere(scene, {x + place(), 100, y + place()}, std::sqrt(0.05 / std::numbers::pi));
  return scene;
}

// A slanted cylinder, 1/8 of a pixel wide, in each row of pixels.
Scene make_hairs() {
  Scene scene = make_view();
  for (int i = 0; i < SIDE; ++i) {
    const double z = i - SIDE / 2 + 0.37;
    add_cone(scene, {-20, 100, z - 0.8}, 0.0625, {20, 100, z + 0.8}, 0.0625);
  }
  return scene;
}

// White lines on a black background, 1/6 of a pixel wide and 5.3 pixels apart.
Scene make_lines() {
  Scene scene = make_view();
  std::vector<std::uint8_t> texels(3 * 32, 0);
  std::fill_n(texels.begin(), 3, std::uint8_t{255});
  scene.pyramids.push_back(make_pyramid(32, 1, texels));
  scene.textures.push_back({0, make_planar({0.1, 0, 0}, {5.3, 0, 0.7}, {0, 0, 5.3})});
  scene.surfaces.back().texture = 0;
  add_half_plane(scene, -500);
  return scene;
}

// A half plane, which is not in the picture, casts a shadow on a wall. The light is 4 pixels wide.
Scene make_shadow_edge() {
  Scene scene = make_view();
  add_half_plane(scene, -500);
  add_polygon(scene,
              std::vector<Vec>{{15, 85, -500}, {15, 85, 500}, {515, 585, 500}, {515, 585, -500}});
  scene.lights.push_back(
      {.at = {30, 70, 0}, .shape = LightShape::rectangle, .u = {1, 1, 0}, .v = {0, 0, 2}});
  return scene;
}

struct Case {
  const char* name;
  Scene (*make)();
  int seeds;
};
constexpr Case CASES[] = {{"blurred_edge", make_blurred_edge, 40},
                          {"dots", make_dots, 240},
                          {"hairs", make_hairs, 60},
                          {"lines", make_lines, 10},
                          {"shadow_edge", make_shadow_edge, 10}};

// A mean over pixels and seeds, with its standard error.
struct Mean {
  double value = 0, error = 0;
};

Mean eval_mean(const Scene& scene, double adaptive, int first_seed, int seeds) {
  Params params = make_params(SIDE, SIDE, 2);
  params.ambient = scene.lights.empty() ? 0.3 : 0;
  params.sampling.pixel_samples = 64;
  params.sampling.adaptive = adaptive;
  double sum = 0, squares = 0;
  for (int i = 0; i < seeds; ++i) {
    params.sampling.seed = static_cast<std::uint64_t>(first_seed + i);
    const auto image = render(scene, params).samples;
    double mean = 0;
    for (std::uint32_t pixel = 0; pixel < SIDE * SIDE; ++pixel)
      mean += image.get(pixel).g / (SIDE * SIDE);
    sum += mean;
    squares += mean * mean;
  }
  const double mean = sum / seeds;
  return {mean, std::sqrt(std::max(0.0, squares / seeds - mean * mean) / (seeds - 1))};
}

class Unbiased : public testing::TestWithParam<Case> {};

TEST_P(Unbiased, TheMeanIsThatOfPlainSampling) {
  Scene scene = GetParam().make();
  finish(scene);
  const int seeds = GetParam().seeds;
  const Mean plain = eval_mean(scene, 0, 1000, seeds / 2);
  for (const double adaptive : {0.002, 0.005, 0.02}) {
    const Mean found = eval_mean(scene, adaptive, 1, seeds);
    EXPECT_NEAR(found.value / plain.value, 1, 0.01) << "adaptive " << adaptive;
    EXPECT_LT(std::hypot(found.error, plain.error), 0.004 * plain.value);
  }
}

INSTANTIATE_TEST_SUITE_P(Adaptive, Unbiased, testing::ValuesIn(CASES),
                         [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace renderer::test

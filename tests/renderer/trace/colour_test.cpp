// Tests textures as seen by rays.
#include <gtest/gtest.h>

#include "tests/renderer/support.hpp"

namespace renderer::test {
namespace {

// A checkerboard of 8 x 8 squares in black and white, of 8 x 8 pixels each.
Pyramid make_checkerboard() {
  constexpr int SIDE = 64, SQUARE = 8;
  std::vector<std::uint8_t> bytes;
  for (int y = 0; y < SIDE; ++y)
    for (int x = 0; x < SIDE; ++x)
      bytes.insert(bytes.end(), 3, (x / SQUARE + y / SQUARE) % 2 ? 255 : 0);
  return make_pyramid(SIDE, SIDE, bytes);
}

Surface make_textured(std::uint32_t texture) {
  Surface surface;
  surface.texture = texture;
  return surface;
}

// A floor at z = 0 that extends to the horizon. It has a checkerboard of period 1, and only ambient
// light.
Scene make_floor(const Vec& from, const Vec& at) {
  Scene scene;
  scene.view.from = from;
  scene.view.at = at;
  scene.view.up = {0, 0, 1};
  scene.pyramids.push_back(make_checkerboard());
  scene.textures.push_back({0, make_planar({}, {1, 0, 0}, {0, 1, 0})});
  scene.surfaces.push_back(make_textured(0));
  const double far = 1e4;
  add_polygon(scene,
              std::vector<Vec>{{-far, -far, 0}, {far, -far, 0}, {far, far, 0}, {-far, far, 0}});
  finish(scene);
  return scene;
}

Params make_ambient(int width, int height) {
  Params params = make_params(width, height, 1);
  params.ambient = 1;
  params.sample = SamplePosition::center;
  return params;
}

struct Moments {
  double mean = 0, variance = 0;
};
Moments find_spread(const std::vector<double>& values) {
  Moments spread;
  const auto n = static_cast<double>(values.size());
  for (const double value : values) spread.mean += value / n;
  for (const double value : values)
    spread.variance += (value - spread.mean) * (value - spread.mean) / n;
  return spread;
}

TEST(Colour, ACheckerboardFarAwayIsGrey) {
  // The floor is 40 to 100 periods away, so that a pixel covers more than one period.
  const Scene scene = make_floor({0.3, 0.2, 2}, {60, 7, 0});
  Params params = make_ambient(80, 60);
  params.area = {0, 30, 80, 8};
  const Rendering found = render(scene, params);
  std::vector<double> filtered, unfiltered;
  for (int y = params.area.y; y < params.area.y + params.area.height; ++y)
    for (int x = 0; x < params.width; ++x) {
      Work work;
      const Ray ray = make_primary(scene.view, params, x, y);
      const auto hit = intersect(scene, ray, params.traversal, work);
      ASSERT_TRUE(hit);
      filtered.push_back(found.samples.get(ray.sample).g);
      unfiltered.push_back(
          eval_bilinear(scene.pyramids[0].levels[0], hit->point.x, hit->point.y).g);
    }
  EXPECT_NEAR(find_spread(filtered).mean, 0.5, 0.005);
  EXPECT_LT(find_spread(filtered).variance, 1e-4);
  EXPECT_GT(find_spread(unfiltered).variance, 0.15);  // black and white have the variance 0.25
}

TEST(Colour, ACheckerboardNearbyIsSharp) {
  // A pixel is 1/100 of a period wide and a texel 1/64, so that the texture is not filtered.
  const Scene scene = make_floor({0.3, 0.2, 1}, {0.3, 0.21, 0});
  Params params = make_ambient(64, 64);
  params.height = params.width = 83;
  const Rendering found = render(scene, params);
  double largest = 0;
  for (int y = 0; y < params.height; ++y)
    for (int x = 0; x < params.width; ++x) {
      Work work;
      const Ray ray = make_primary(scene.view, params, x, y);
      const auto hit = intersect(scene, ray, params.traversal, work);
      ASSERT_TRUE(hit);
      const Rgb expected = eval_bilinear(scene.pyramids[0].levels[0], hit->point.x, hit->point.y);
      largest = std::max(largest, std::abs(found.samples.get(ray.sample).g - expected.g));
    }
  EXPECT_LT(largest, 1e-9);
}

TEST(Colour, AllSamplesOfAnImageAreFilteredAlike) {
  const Scene scene = make_floor({0, 0, 2}, {9, 1, 0});
  const Hit hit{4, {3.1, 1.2, 0}, {0, 0, 1}, 0, 0, false};
  Ray ray;
  ray.direction = normalize({30, 1, -2});
  const auto get = [&](int samples, double adaptive, int side = 100) {
    Params params = make_ambient(side, side);
    params.sampling.pixel_samples = samples;
    params.sampling.adaptive = adaptive;
    Work work;
    return colour_of(scene, params, ray, hit, work);
  };
  EXPECT_EQ(get(4, 0), get(256, 0));
  EXPECT_EQ(get(4, 0), get(64, 0.01));
  EXPECT_NE(get(1, 0), get(4, 0));
  // 2 x 2 samples are filtered like the pixels of an image twice as wide and high.
  EXPECT_EQ(get(4, 0), get(1, 0, 200));
}

TEST(Colour, TimesTheSurfacesInAmbientAndDiffuseLight) {
  Scene scene;
  scene.pyramids.push_back(make_pyramid(1, 1, std::vector<std::uint8_t>{255, 51, 0}));
  scene.textures.push_back({0, make_planar({}, {1, 0, 0}, {0, 1, 0})});
  scene.lights.push_back({{0, 0, 5}, {1, 1, 1}});
  Surface surface = make_textured(0);
  surface.colour = {0.5, 0.5, 0.25};
  surface.kd = 0.8;
  scene.surfaces.push_back(surface);
  add_sphere(scene, {}, 1);
  scene.view.from = {0, 0, 5};
  finish(scene);
  Params params = make_ambient(1, 1);
  params.ambient = 0.1;
  const Rendering found = render(scene, params);
  // The point is seen and lit from directly above.
  const Rgb colour = found.samples.get(0);
  EXPECT_NEAR(colour.r, 0.8 * 1.1 * 0.5, 1e-9);
  EXPECT_NEAR(colour.g, 0.8 * 1.1 * 0.5 * 0.2, 1e-9);
  EXPECT_EQ(colour.b, 0);
  // The texture is evaluated once for ambient light, and once for all rays to lights.
  EXPECT_EQ(found.work[Op::texture_mapped], 2u);
  EXPECT_EQ(found.work[Op::texel_mixed], 8u);
}

TEST(Colour, ATextureTravelsWithItsObject) {
  Scene scene = make_floor({0, 0, 2}, {1, 0, 0});
  const Vec move{0.31, 0.17, 0};
  const Params params = make_ambient(400, 400);
  Ray ray;
  ray.direction = {0, 0, -1};
  const auto get = [&](const Vec& point) {
    Work work;
    return colour_of(scene, params, ray, {0.01, point, {0, 0, 1}, 0, 0, false}, work).g;
  };
  const double still = get({0.13, 0.2, 0});
  scene.moves.push_back(move);
  ray.time = 0.5;
  EXPECT_NEAR(get(Vec{0.13, 0.2, 0} + 0.5 * move), still, 1e-12);
  EXPECT_GT(std::abs(get({0.13, 0.2, 0}) - still), 0.1);
}

TEST(Colour, AnyThreadsAnyOrderTheSameBits) {
  Scene scene = make_random_scene(4, 40);
  scene.pyramids.push_back(make_checkerboard());
  scene.textures.push_back({0, make_spherical({}, {0, 1, 1})});
  for (std::size_t i = 0; i < scene.surfaces.size(); i += 2) scene.surfaces[i].texture = 0;
  Params params = make_params(40, 30, 4);
  params.sampling.pixel_samples = 3;
  const Rendering one = render(scene, params);
  EXPECT_GT(one.work[Op::texture_mapped], 1000u);
  for (const int threads : {2, 5}) {
    const Rendering more = render(scene, params, threads);
    EXPECT_EQ(more.samples, one.samples);
    EXPECT_EQ(more.work, one.work);
  }
  Samples pieces(40, 30);
  Work work;
  for (const Area& area : {Area{20, 0, 20, 30}, Area{0, 17, 20, 13}, Area{0, 0, 20, 17}})
    add_block(pieces, render_block(scene, params, area), work);
  EXPECT_EQ(pieces, one.samples);
}

}  // namespace
}  // namespace renderer::test

// Tests that the incremental sum of contributions with influence factors (thesis, Eq 4.19) equals
// Whitted's recursion (Eq 4.8), which is implemented here.

#include <gtest/gtest.h>

#include "tests/renderer/support.hpp"

namespace renderer::test {
namespace {

struct Whitted {
  const Scene& scene;
  const Params& params;
  Work ignored{};

  std::optional<Hit> meet(const Vec& origin, const Vec& direction, std::uint32_t from,
                          double reach = Bounds::INF) {
    Ray ray{
        .origin = origin, .direction = direction, .influence = {}, .reach = reach, .from = from};
    return intersect(scene, ray, Traversal::linear, ignored);
  }

  Rgb shade(const Vec& origin, const Vec& direction, std::uint32_t from, int level) {
    const std::optional<Hit> hit = meet(origin, direction, from);
    if (!hit) return scene.background;
    const Surface& s = scene.surfaces[hit->surface];
    const Vec& n = hit->normal;
    const Vec mirrored = normalize(direction - 2 * dot(n, direction) * n);
    Rgb sum = params.ambient * s.kd * s.colour;
    for (const Light& light : scene.lights) {
      const double distance = length(light.at - hit->point);
      const Vec to_light = normalize(light.at - hit->point);
      if (dot(n, to_light) <= 0 || meet(hit->point, to_light, hit->object, distance)) continue;
      const double highlight = s.ks * std::pow(std::max(0.0, dot(mirrored, to_light)), s.shine);
      sum += light.intensity *
             (s.kd * dot(n, to_light) * s.colour + Rgb{highlight, highlight, highlight});
    }
    if (level == params.limits.depth) return sum;
    if (s.ks > 0) sum += s.ks * shade(hit->point, mirrored, hit->object, level + 1);
    const auto refracted = refract(direction, n, hit->inside ? 1 / s.ior : s.ior);
    if (s.t > 0)
      sum += s.t * shade(hit->point, refracted.value_or(mirrored), hit->object, level + 1);
    return sum;
  }
};

TEST(Incremental, EqualsWhittedRecursion) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const Scene scene = make_random_scene(seed, 20);
    const Params params = make_params(24, 24, 6);
    const Rendering rendering = render(scene, params);
    EXPECT_GT(rendering.rays.reflected, 0u);
    EXPECT_GT(rendering.rays.transmitted, 0u);
    Whitted whitted{scene, params};
    for (int y = 0; y < params.height; ++y)
      for (int x = 0; x < params.width; ++x) {
        const Ray primary = make_primary(scene.view, params, x, y);
        const Rgb expected = whitted.shade(primary.origin, primary.direction, NO_OBJECT, 1);
        const Rgb found = rendering.samples.get(primary.sample);
        // Highlights are rounded to 24 bits (float).
        ASSERT_NEAR(found.r, expected.r, 1e-6) << x << ", " << y;
        ASSERT_NEAR(found.g, expected.g, 1e-6) << x << ", " << y;
        ASSERT_NEAR(found.b, expected.b, 1e-6) << x << ", " << y;
      }
  }
}

TEST(Incremental, OneSphereByHand) {
  // Seen and lit head on: ambient 0.1 * 0.5 * c, diffuse 0.5 * c, highlight 0.25, mirror 0.25 * b.
  // (c is the surface's colour, b the background.)
  const Scene scene = parse(
      "v from 0 0 5 at 0 0 0 up 0 1 0 angle 45\nb 0 0 0.5\nl 0 0 5 1 1 1\n"
      "f 0.5 1 0 0.5 0.25 8 0 0\ns 0 0 0 1\n");
  Params params = make_params(1, 1, 2);
  params.sample = SamplePosition::center;
  const Rgb found = render(scene, params).samples.get(0);
  EXPECT_NEAR(found.r, 0.025 + 0.25 + 0.25, 1e-9);
  EXPECT_NEAR(found.g, 0.05 + 0.5 + 0.25, 1e-9);
  EXPECT_NEAR(found.b, 0.25 + 0.125, 1e-9);
}

// For a light on the surface itself, the direction to the light is the normal.
TEST(Incremental, ALightOnTheSurfaceShinesFromAbove) {
  const Scene scene = parse(
      "v from 0 0 5 at 0 0 0 up 0 1 0 angle 45\nl 0 0 0 1 1 1\nf 0.5 1 0 0.5 0 8 0 0\n"
      "p 4 -1 -1 0 1 -1 0 1 1 0 -1 1 0\n");
  Params params = make_params(1, 1, 1);
  params.sample = SamplePosition::center;
  const Rgb found = render(scene, params).samples.get(0);
  EXPECT_NEAR(found.r, 0.025 + 0.25, 1e-9);
  EXPECT_NEAR(found.g, 0.05 + 0.5, 1e-9);
  EXPECT_EQ(found.b, 0);
}

}  // namespace
}  // namespace renderer::test

// Tests the transmission of light through transparent objects.

#include <gtest/gtest.h>

#include "tests/renderer/support.hpp"

namespace renderer::test {
namespace {

TEST(Refraction, ObeysSnell) {
  Random random{1};
  int total_reflections = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec n = random.direction();
    Vec in = random.direction();
    if (dot(in, n) > 0) in = -in;
    const double ratio = random.range(0.5, 2), sine_in = length(cross(in, n));
    const std::optional<Vec> out = refract(in, n, ratio);
    if (sine_in / ratio > 1 + 1e-12) {
      EXPECT_FALSE(out);
      ++total_reflections;
      continue;
    }
    ASSERT_TRUE(out);
    EXPECT_NEAR(length(*out), 1, 1e-12);
    EXPECT_NEAR(length(cross(*out, n)), sine_in / ratio, 1e-9);
    EXPECT_LE(dot(*out, n), 0) << "goes on through the surface";
    EXPECT_NEAR(dot(*out, cross(in, n)), 0, 1e-9) << "stays in the plane of incidence";
  }
  EXPECT_GT(total_reflections, 50);
}

Scene make_glass_ball(const std::string& ior) {
  return parse(
      "v from 0 0 5 at 0 0 0 up 0 1 0 angle 45\nb 1 1 1\n"
      "f 1 1 1 0 0 0 1 " +
      ior + "\ns 0 0 0 1\n");
}

TEST(Refraction, ThroughABallARayEntersAndLeaves) {
  const Scene scene = make_glass_ball("1.5");
  const Params params = make_params(1, 1, 15);
  Random random{2};
  for (int i = 0; i < 100; ++i) {
    Ray ray{.origin = {0, 0, 5},
            .direction = normalize(random.point(0.55) - Vec{0, 0, 5}),
            .influence = {1, 1, 1}};
    Work work;
    Children rays = {ray};
    const auto step = [&] {
      const std::optional<Hit> hit = intersect(scene, rays[0], Traversal::nearest, work);
      if (!hit) return false;
      const Ray parent = rays[0];
      rays.clear();
      make_children(scene, params, parent, *hit, rays, work);
      return true;
    };
    ASSERT_TRUE(step());
    ASSERT_EQ(rays.size(), 1u);
    const Ray inner = rays[0];
    EXPECT_EQ(inner.kind, RayKind::transmitted);
    EXPECT_TRUE(inner.through);
    EXPECT_EQ(inner.level, 2);
    ASSERT_TRUE(step());
    ASSERT_EQ(rays.size(), 1u);
    // The angle between ray and radius must be equal where the ray enters the sphere and where it
    // leaves.
    EXPECT_NEAR(length(cross(rays[0].direction, rays[0].origin)),
                length(cross(ray.direction, inner.origin)), 1e-9);
    EXPECT_FALSE(step()) << "outside again";
  }
}

TEST(Refraction, DescendantsOfATransmittedRayKnowIt) {
  const Scene scene = parse(
      "v from 0 0 5 at 0 0 0 up 0 1 0 angle 45\nl 9 9 9\nf 1 1 1 0.5 0.5 9 0.5 1.5\ns 0 0 0 1\n");
  const Params params = make_params(8, 8, 4);
  Work work;
  Children rays = {make_primary(scene.view, params, 4, 4)};
  std::array<int, 2> feelers{};
  while (!rays.empty()) {
    const Ray ray = rays.back();
    rays.pop_back();
    const std::optional<Hit> hit = intersect(scene, ray, Traversal::nearest, work);
    if (!hit) continue;
    const std::size_t first = rays.size();
    make_children(scene, params, ray, *hit, rays, work);
    for (std::size_t i = first; i < rays.size(); ++i) {
      EXPECT_EQ(rays[i].through, ray.through || rays[i].kind == RayKind::transmitted);
      EXPECT_EQ(rays[i].level, ray.level + 1);
      if (rays[i].kind == RayKind::shadow) ++feelers[rays[i].through ? 1 : 0];
    }
  }
  EXPECT_EQ(feelers, (std::array{1, 3})) << "from outside, and from inside on three levels";
}

TEST(Refraction, GlassOfIndexOneIsNotThere) {
  Params params = make_params(32, 32, 3);
  const Rendering found = render(make_glass_ball("1"), params);
  EXPECT_GT(found.rays.transmitted, 0u);
  for (const Samples::Sums& s : found.samples.sums) EXPECT_EQ(s.r, std::int64_t{1} << 32);
}

TEST(Refraction, TotalReflectionMirrorsBothShares) {
  // The ray comes from inside glass, at 60 degrees to the normal of the glass's face.
  const Scene scene = parse(
      "v from 0 0 5 at 0 0 0 up 0 1 0 angle 45\nf 1 1 1 0 0.5 0 0.5 1.5\n"
      "p 4 -9 -9 0  9 -9 0  9 9 0  -9 9 0\n");
  Work work;
  Children children;
  const Ray ray{
      .origin = {0, 0, -1}, .direction = {std::sqrt(0.75), 0, 0.5}, .influence = {1, 1, 1}};
  const std::optional<Hit> hit = intersect(scene, ray, Traversal::nearest, work);
  ASSERT_TRUE(hit);
  EXPECT_TRUE(hit->inside);
  make_children(scene, Params{}, ray, *hit, children, work);
  ASSERT_EQ(children.size(), 2u);
  EXPECT_EQ(children[0].kind, RayKind::reflected);
  EXPECT_EQ(children[1].kind, RayKind::transmitted);
  EXPECT_EQ(children[1].direction, children[0].direction);
  for (const Ray& child : children) EXPECT_EQ(max_influence(child), 0.5);

  Params lost;
  lost.total_reflection = TotalReflection::lost;
  children.clear();
  make_children(scene, lost, ray, *hit, children, work);
  ASSERT_EQ(children.size(), 1u);
  EXPECT_EQ(children[0].kind, RayKind::reflected);
}

// A 45 degree prism with the index of refraction 1.5 turns the view from +x to -z: to a red floor,
// not a green wall. The ray enters and leaves at right angles, so that no light is lost.
TEST(Refraction, APrismTurnsTheView) {
  const Scene scene = parse(
      "v from -3 0 0.4 at 0 0 0.4 up 0 1 0 angle 10\nb 0 0 1\n"
      "f 1 1 1 0 0 0 1 1.5\n"
      "p 3 0 -5 0  1 -5 0  0 -5 1\np 3 0 5 1  1 5 0  0 5 0\np 4 0 5 0  1 5 0  1 -5 0  0 -5 0\n"
      "p 4 0 -5 1  0 5 1  0 5 0  0 -5 0\np 4 1 5 0  0 5 1  0 -5 1  1 -5 0\n"
      "f 1 0 0 1 0 0 0 1\np 4 -5 -5 -2  5 -5 -2  5 5 -2  -5 5 -2\n"
      "f 0 1 0 1 0 0 0 1\np 4 3 -5 -1.9  3 5 -1.9  3 5 5  3 -5 5\n");
  Params params = make_params(16, 16, 15);
  params.ambient = 1;
  const Rendering found = render(scene, params);
  for (const Samples::Sums& s : found.samples.sums) {
    EXPECT_EQ(s.r, std::int64_t{1} << 32);
    EXPECT_EQ(s.g + s.b, 0);
  }
  params.total_reflection = TotalReflection::lost;
  for (const Samples::Sums& s : render(scene, params).samples.sums) EXPECT_EQ(s.r, 0);
}

// A white furnace that contains clear glass is white in every direction, except for the light that
// the limit on depth removes.
TEST(Refraction, ClosedGlassLosesNoLight) {
  const Scene scene = parse(
      "v from 0 0 5 at 0 0 0 up 0 1 0 angle 45\nb 1 1 1\nf 1 1 1 0 0 0 1 1.5\n"
      "s 0 0 0 1.2\nf 1 1 1 0 0 0 1 0.6666666666666667\ns 0 0 0 1.1\n");
  const Params params = make_params(64, 64, 60);
  for (const Samples::Sums& s : render(scene, params).samples.sums)
    EXPECT_NEAR(static_cast<double>(s.g), 0x1p32, 1);
}

}  // namespace
}  // namespace renderer::test

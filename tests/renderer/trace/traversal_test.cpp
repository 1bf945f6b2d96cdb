// Tests that the hit does not depend on the method of traversal.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "renderer/scene/generators.hpp"
#include "tests/renderer/support.hpp"

namespace renderer::test {
namespace {

constexpr Traversal TRAVERSALS[] = {Traversal::linear, Traversal::exhaustive, Traversal::nearest};

TEST(Traversal, ImagesAndCountsAreEqual) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const Scene scene = make_random_scene(seed, static_cast<int>(seed * 7), 3);
    std::vector<Rendering> found;
    for (const Traversal t : TRAVERSALS) found.push_back(render(scene, make_params(32, 32, 5, t)));
    for (const Rendering& other : found) {
      EXPECT_EQ(other.samples, found[0].samples);
      EXPECT_EQ(other.rays, found[0].rays);
    }
    EXPECT_EQ(found[0].work[Op::box_test], 0u);
    EXPECT_LE(found[2].work[Op::box_test], found[1].work[Op::box_test]);
  }
}

TEST(Traversal, HitsAreEqualToTheLastBit) {
  const Scene scene = make_random_scene(99, 200);
  Random random{7};
  int hits = 0;
  for (int i = 0; i < 5000; ++i) {
    SCOPED_TRACE(testing::Message() << "ray " << i);
    // Some rays run parallel to the axes, and never leave the slab of a box.
    const Vec axes[] = {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}};
    Ray ray{.origin = random.point(2), .direction = random.direction(), .influence = {}};
    if (i % 4 == 0) ray.direction = axes[i / 4 % 3];
    Work work;
    std::optional<Hit> first = intersect(scene, ray, Traversal::linear, work);
    for (const Traversal t : TRAVERSALS) {
      const std::optional<Hit> hit = intersect(scene, ray, t, work);
      ASSERT_EQ(hit.has_value(), first.has_value());
      if (!hit) continue;
      ++hits;
      ASSERT_EQ(hit->distance, first->distance);
      ASSERT_EQ(hit->object, first->object);
      ASSERT_EQ(hit->normal, first->normal);
    }
  }
  EXPECT_GT(hits, 1000);
}

// Rectangles lie in one plane. Their sizes and positions give the hierarchy an order other than
// that of the file. (Sides are powers of two, so that distances have no rounding errors.)
TEST(Traversal, OfCoincidentObjectsTheFirstIsHit) {
  Random random{11};
  struct Rectangle {
    double x, y, width, height;
  };
  std::vector<Rectangle> all;
  std::string text = "v from 0 0 5 at 0 0 0 up 0 1 0 angle 45\nf 1 1 1 1 0 0 0 0\n";
  for (int i = 0; i < 60; ++i) {
    const auto place = [&] { return 0.125 * (random.below(136) - 72); };
    const auto side = [&] { return 0.5 * (1 << random.below(5)); };
    all.push_back({place(), place(), side(), side()});
    const auto& [x, y, w, h] = all.back();
    text += fmt::format("p 4 {0} {1} 1 {2} {1} 1 {2} {3} 1 {0} {3} 1\n", x, y, x + w, y + h);
  }
  const Scene scene = parse(text);
  int ties = 0;
  for (int i = 0; i < 1000; ++i) {
    const double x = random.range(-9, 9), y = random.range(-9, 9);
    std::vector<std::uint32_t> there;
    for (std::uint32_t k = 0; k < all.size(); ++k)
      if (x > all[k].x && x < all[k].x + all[k].width && y > all[k].y &&
          y < all[k].y + all[k].height)
        there.push_back(k);
    ties += there.size() > 1;
    for (const Traversal t : TRAVERSALS) {
      Work work;
      const Ray ray{.origin = {x, y, 5}, .direction = {0, 0, -1}, .influence = {}};
      const std::optional<Hit> hit = intersect(scene, ray, t, work);
      ASSERT_EQ(hit.has_value(), !there.empty()) << i;
      if (!hit) continue;
      EXPECT_EQ(hit->object, there.front()) << i;
      EXPECT_EQ(hit->distance, 4);
    }
  }
  EXPECT_GT(ties, 200);
}

TEST(Traversal, AFeelerReachesItsLightAndNoFurther) {
  const Scene scene =
      parse("v from 0 0 5 at 0 0 0 up 0 1 0 angle 45\nf 1 1 1 1 0 0 0 0\ns 0 0 0 1\n");
  for (const Traversal t : TRAVERSALS) {
    Ray ray{.origin = {0, 0, 5}, .direction = {0, 0, -1}, .influence = {}, .reach = 4};
    ray.kind = RayKind::shadow;
    Work work;
    EXPECT_FALSE(intersect(scene, ray, t, work));
    ray.reach = 4.000001;
    EXPECT_TRUE(intersect(scene, ray, t, work));
  }
}

}  // namespace
}  // namespace renderer::test

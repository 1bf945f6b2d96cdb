// Tests that an Access object is called for every read of the scene, and for nothing else. The hits
// must not change.

#include <gtest/gtest.h>

#include "tests/renderer/support.hpp"

namespace renderer::test {
namespace {

struct Counter : Access {
  explicit Counter(const Scene& scene) : scene(scene) {}
  void box(std::uint32_t index, const Work& done) override {
    EXPECT_EQ(scene.hierarchy.boxes.at(index).item, Box::INNER);
    EXPECT_EQ(done[Op::box_test], boxes);
    ++boxes;
  }
  void object(Place place, const Work& done) override {
    static constexpr Op TESTS[] = {Op::sphere_test, Op::polygon_test, Op::patch_test,
                                   Op::cone_test};
    const auto kind = static_cast<std::size_t>(place.kind());
    EXPECT_EQ(done[TESTS[kind]], objects[kind]);
    ++objects[kind];
  }
  const Scene& scene;
  std::uint64_t boxes = 0, objects[4] = {};
};

void expect_counts(const Counter& seen, const Work& work) {
  EXPECT_EQ(seen.boxes, work[Op::box_test]);
  EXPECT_EQ(seen.objects[0], work[Op::sphere_test]);
  EXPECT_EQ(seen.objects[1], work[Op::polygon_test]);
  EXPECT_EQ(seen.objects[2], work[Op::patch_test]);
  EXPECT_EQ(seen.objects[3], work[Op::cone_test]);
}

class AccessOf : public testing::TestWithParam<Traversal> {};

TEST_P(AccessOf, IsToldOfEveryTest) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const Scene scene = make_random_scene(seed, static_cast<int>(seed * 7), 3);
    const Params params = make_params(32, 24, 4, GetParam());
    const Area area{static_cast<int>(seed), 3, 11, 8};
    Counter seen(scene);
    const Block found = render_block(scene, params, area, &seen);
    const Block expected = render_block(scene, params, area);
    EXPECT_EQ(found.samples, expected.samples);
    EXPECT_EQ(found.rays, expected.rays);
    EXPECT_EQ(found.work, expected.work);
    expect_counts(seen, expected.work);
  }
}

TEST_P(AccessOf, ChangesNoHit) {
  const Scene scene = make_random_scene(5, 150);
  Random random{11};
  Counter seen(scene);
  Work work, told;
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    SCOPED_TRACE(testing::Message() << "ray " << i);
    Ray ray{.origin = random.point(2), .direction = random.direction(), .influence = {}};
    if (i % 3 == 0) ray.kind = RayKind::shadow;
    if (i % 5 == 0) ray.reach = random.range(0, 3);
    const auto expected = intersect(scene, ray, GetParam(), work);
    const auto hit = intersect(scene, ray, GetParam(), told, &seen);
    ASSERT_EQ(hit.has_value(), expected.has_value());
    if (!hit) continue;
    ++hits;
    ASSERT_EQ(hit->distance, expected->distance);
    ASSERT_EQ(hit->object, expected->object);
  }
  EXPECT_GT(hits, 100);
  EXPECT_EQ(told, work);
  expect_counts(seen, work);
}

INSTANTIATE_TEST_SUITE_P(Traversals, AccessOf,
                         testing::Values(Traversal::linear, Traversal::exhaustive,
                                         Traversal::nearest));

}  // namespace
}  // namespace renderer::test

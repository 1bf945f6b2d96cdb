// Tests that a bounding-volume hierarchy is valid for any objects.

#include <gtest/gtest.h>

#include <numeric>

#include "tests/renderer/support.hpp"

namespace renderer::test {
namespace {

// Checks the box with the index `at` and all boxes inside it. Returns the index after the last of
// them.
std::uint32_t check_subtree(const std::vector<Box>& boxes, std::uint32_t at,
                            const std::vector<Bounds>& objects, std::vector<std::uint32_t>& met) {
  const Box& box = boxes[at];
  if (box.item != Box::INNER) {
    met.push_back(box.item);
    EXPECT_EQ(box.bounds, objects[box.item]);
    EXPECT_EQ(box.skip, at + 1);
    return at + 1;
  }
  EXPECT_LE(box.skip, boxes.size());
  std::uint32_t child = at + 1, children = 0;
  Bounds content;
  for (; child < box.skip && children < boxes.size(); ++children) {
    content = join(content, boxes[child].bounds);
    const std::uint32_t after = check_subtree(boxes, child, objects, met);
    EXPECT_EQ(boxes[child].skip, after);
    child = after;
  }
  EXPECT_EQ(child, box.skip);
  EXPECT_GE(children, 2u);
  EXPECT_EQ(box.bounds, content) << "as tight as can be";
  return child;
}

TEST(Hierarchy, Invariants) {
  for (std::uint64_t seed = 0; seed <= 40; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    std::vector<Bounds> objects;
    for (std::uint64_t i = 0; i < seed * seed / 2; ++i) {
      const Vec at = random.point(10);
      objects.push_back(join(Bounds{at, at}, at + random.point(random.unit())));
    }
    const std::vector<Box> boxes = make_hierarchy(objects).boxes;
    std::vector<std::uint32_t> met, all(objects.size());
    std::iota(all.begin(), all.end(), 0u);
    const std::uint32_t end = objects.empty() ? 0 : check_subtree(boxes, 0, objects, met);
    EXPECT_EQ(end, boxes.size());
    std::sort(met.begin(), met.end());
    EXPECT_EQ(met, all) << "every object once";
  }
}

TEST(Hierarchy, CoincidentObjects) {
  const std::vector<Bounds> objects(100, Bounds{{0, 0, 0}, {1, 1, 1}});
  std::vector<std::uint32_t> met;
  const std::vector<Box> boxes = make_hierarchy(objects).boxes;
  EXPECT_EQ(check_subtree(boxes, 0, objects, met), boxes.size());
  EXPECT_EQ(met.size(), objects.size());
}

TEST(Hierarchy, ManyCoincidentObjectsAreNotCompared) {
  const std::vector<Bounds> objects(30'000, Bounds{{0, 0, 0}, {1, 1, 1}});
  std::vector<std::uint32_t> met;
  const std::vector<Box> boxes = make_hierarchy(objects).boxes;
  EXPECT_EQ(check_subtree(boxes, 0, objects, met), boxes.size());
  EXPECT_EQ(met.size(), objects.size());
  EXPECT_EQ(boxes[boxes[1].skip].skip, boxes.size()) << "two children: those inserted, the others";
}

TEST(Hierarchy, TwoClustersGetABoxEach) {
  std::vector<Bounds> objects;
  for (const double x : {0.0, 100.0, 1.0, 101.0})
    objects.push_back({{x, 0, 0}, {x + 0.5, 0.5, 0.5}});
  std::vector<std::uint32_t> met;
  check_subtree(make_hierarchy(objects).boxes, 0, objects, met);
  EXPECT_EQ(met, (std::vector<std::uint32_t>{0, 2, 1, 3}));
}

TEST(Hierarchy, PrimitivesLieInTheOrderOfTheLeaves) {
  const Scene scene = make_random_scene(4, 150);
  std::array<std::uint32_t, 4> next{};
  for (const Box& box : scene.hierarchy.boxes) {
    if (box.item == Box::INNER) continue;
    const Place place{box.item};
    EXPECT_EQ(place.index(), next[static_cast<std::size_t>(place.kind())]++);
  }
  EXPECT_EQ(object_count(scene), 150u);
  EXPECT_EQ(box_count(scene) + 150, scene.hierarchy.boxes.size());
  for (std::uint32_t i = 0; i < scene.objects.size(); ++i)
    if (scene.objects[i].kind() == Kind::cone) {
      EXPECT_EQ(scene.cones[scene.objects[i].index()].tag.object, i);
    }
}

}  // namespace
}  // namespace renderer::test

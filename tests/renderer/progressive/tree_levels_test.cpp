// Tests shading trees that are deepened in steps: numbers of rays are compared with thesis Eq 4.1,
// 4.3, 4.4 and 4.6.

#include "renderer/progressive/tree_levels.hpp"

#include <gtest/gtest.h>

#include "renderer/progressive/progressive.hpp"
#include "renderer/scene/generators.hpp"
#include "tests/renderer/support.hpp"

namespace renderer::progressive {
namespace {

using renderer::test::make_params;
using renderer::test::make_random_scene;

constexpr int LEVELS = 8;

// A scene for a single ray. Its planes are perpendicular to z and extend from -9 to 9 along y.
struct Planes {
  Scene scene;

  explicit Planes(int lights) {
    // The upper left pixel looks along `ahead`, because the view angle is tiny.
    scene.view.up = {1, 0, 0};
    scene.view.angle = 1e-6;
    for (int i = 0; i < lights; ++i) scene.lights.push_back({{0, 0, 0.1 * i}, {1, 1, 1}});
  }
  void add(double z, double from_y, double to_y, const Surface& surface) {
    scene.surfaces.push_back(surface);
    const Vec corners[] = {{-1, from_y, z}, {1, from_y, z}, {1, to_y, z}, {-1, to_y, z}};
    add_polygon(scene, corners);
  }
  Scene finished(const Vec& from, const Vec& at) {
    scene.view.from = from;
    scene.view.at = at;
    finish(scene);
    return scene;
  }
};

const Surface MIRROR{.colour = {1, 1, 1}, .kd = 0, .ks = 1, .shine = 1, .t = 0, .ior = 1};
const Surface SHEET{.colour = {1, 1, 1}, .kd = 0, .ks = 0.5, .shine = 1, .t = 0.5, .ior = 1};

// Two facing mirrors, between which every ray has one child.
Scene make_list(int lights) {
  Planes planes(lights);
  planes.add(0, -1, 100, MIRROR);
  planes.add(1, -1, 100, MIRROR);
  return planes.finished({0, 0, 0.5}, {0, 1, 1});
}

// Sheets that reflect half of the light and transmit half. There are more sheets than levels of a
// tree, so that every ray has two children.
Scene make_complete(int lights) {
  Planes planes(lights);
  for (int z = -LEVELS; z <= LEVELS; ++z) planes.add(z, -100, 100, SHEET);
  return planes.finished({0, 0, 0.5}, {0, 1, 1});
}

// A short pane of glass between two mirrors (figure 4.3). A ray inside the pane has two children:
// one stays inside, the other goes to and fro between the two mirrors, beyond the end of the pane.
Scene make_semi_complete(int lights) {
  Planes planes(lights);
  planes.add(0, -1, 200, MIRROR);
  planes.add(10, -1, 200, MIRROR);
  planes.add(5, -1, 2, SHEET);
  planes.add(5.125, -1, 2, SHEET);
  return planes.finished({0, -0.5, 6}, {0, 0, 5.5});
}

std::vector<TreeRays> count_steps(const Scene& scene) {
  const Params params = make_params(1, 1, LEVELS);
  Samples samples(1, 1);
  Children stack;
  std::vector<TreeRays> steps(LEVELS + 1);
  for (int m = 1; m <= LEVELS; ++m)
    deepen(scene, params, 0, 0, m - 1, m, samples, steps[static_cast<std::size_t>(m)], stack);
  EXPECT_EQ(samples, render(scene, params).samples);
  return steps;
}

using Formula = std::uint64_t (*)(std::uint64_t m);

void expect_tree(Scene (*make)(int), Formula repeated, Formula rays) {
  for (const int lights : {0, 1, 3, 27}) {
    SCOPED_TRACE(fmt::format("{} lights", lights));
    const auto steps = count_steps(make(lights));
    for (std::uint64_t m = 1; m <= LEVELS; ++m) {
      SCOPED_TRACE(fmt::format("level {}", m));
      EXPECT_EQ(steps[m].repeated, repeated(m));
      EXPECT_EQ(steps[m].fresh.total(), rays(m) * static_cast<std::uint64_t>(1 + lights));
    }
  }
}

TEST(TreeLevels, CompleteTree) {
  expect_tree(
      make_complete, [](std::uint64_t m) { return (std::uint64_t{1} << (m - 1)) - 1; },
      [](std::uint64_t m) { return std::uint64_t{1} << (m - 1); });
}

TEST(TreeLevels, CompleteTreeHasTheRatioOfEq41) {
  constexpr int LIGHTS = 3;
  const auto steps = count_steps(make_complete(LIGHTS));
  EXPECT_EQ(steps[3].repeated, 3u);  // as in figure 4.2
  EXPECT_EQ(steps[3].fresh.total(), 16u);
  for (int n = 1; n <= LEVELS; ++n)
    EXPECT_EQ(get_repeated_percent(steps[static_cast<std::size_t>(n)]),
              100 * (1 - std::exp2(1 - n)) / (1 + LIGHTS))
        << n;
}

TEST(TreeLevels, ListEq44) {
  expect_tree(
      make_list, [](std::uint64_t m) { return m - 1; },
      [](std::uint64_t) -> std::uint64_t { return 1; });
}

TEST(TreeLevels, SemiCompleteTreeEq43) {
  expect_tree(
      make_semi_complete, [](std::uint64_t m) { return m * (m - 1) / 2; },
      [](std::uint64_t m) { return m; });
}

TEST(TreeLevels, ManySamplesOfBothKindsEq46) {
  constexpr std::uint64_t LIGHTS = 27, SEMI = 13, LISTS = 87;
  const auto semi = count_steps(make_semi_complete(LIGHTS)), list = count_steps(make_list(LIGHTS));
  const double s = 0.13;
  for (std::size_t m = 1; m <= 5; ++m) {
    const auto found =
        static_cast<double>(SEMI * semi[m].repeated + LISTS * list[m].repeated) /
        static_cast<double>(SEMI * semi[m].fresh.total() + LISTS * list[m].fresh.total());
    const double level = static_cast<double>(m);
    EXPECT_NEAR(found,
                (1 + (level / 2 - 1) * s) * (level - 1) / ((1 + (level - 1) * s) * (1 + LIGHTS)),
                1e-15)
        << m;
  }
}

TEST(TreeLevels, AnyStepsGiveTheImageOfTheLastDepth) {
  for (const std::uint64_t seed : {31u, 32u, 33u}) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    const Scene scene = make_random_scene(seed, 40, 3);
    Params params = make_params(30, 20, 1);
    params.limits.min_influence = 0.01;
    Progressive image(scene, params, 1);
    for (const int depth : {1, 2, 5, 6, 9}) {
      const auto counts = image.advance({.depth = depth, .area = {}});
      params.limits.depth = depth;
      const Rendering whole = render(scene, params);
      EXPECT_EQ(image.sampled().samples, whole.samples) << depth;
      EXPECT_EQ(counts.samples, depth == 1 ? 600u : 0u);
      EXPECT_EQ(counts.deepened, depth == 1 ? 0u : 600u);
    }
  }
}

TEST(TreeLevels, RepeatedRaysAreThoseOfTheLevelsBeforeWithoutFeelers) {
  const Scene scene = make_random_scene(34, 40, 3);
  Params params = make_params(30, 20, 2);
  Progressive image(scene, params, 1);
  image.advance({.depth = 2, .area = {}});
  const RayCounts before = render(scene, params).rays;
  params.limits.depth = 6;
  RayCounts sum = image.advance({.depth = 6, .area = {}}).rays.fresh;
  EXPECT_EQ(image.advance({.depth = 7, .area = {}}).rays.repeated,
            render(scene, params).rays.total() - render(scene, params).rays.shadow);
  sum += before;
  EXPECT_EQ(sum, render(scene, params).rays);
}

// The room of table 4.1. The limit on the influence factor is one step of an 8-bit image, because
// the thesis does not state its limit.
TEST(TreeLevels, TheRoomLiesAboveEq46AndNearTheThesisPractice) {
  const Scene scene = make_room(27);
  Params params = make_params(128, 128, 1);
  params.limits.min_influence = 1.0 / 256;
  Progressive image(scene, params, 1);
  image.advance({.depth = 1, .area = {}});
  const double practice[] = {6.2, 10.8, 15.1, 18.6};
  double s = 0;
  for (int m = 2; m <= 5; ++m) {
    const auto rays = image.advance({.depth = m, .area = {}}).rays;
    if (m == 2) s = static_cast<double>(rays.fresh.transmitted) / (128 * 128);
    const double found = get_repeated_percent(rays), thesis = practice[m - 2];
    EXPECT_GT(found, 100 * (1 + (m / 2.0 - 1) * s) * (m - 1) / ((1 + (m - 1) * s) * 28)) << m;
    EXPECT_GE(found, 0.7 * thesis) << m;
    EXPECT_LE(found, 1.4 * thesis) << m;
  }
  EXPECT_NEAR(s, 0.13, 0.01);
}

}  // namespace
}  // namespace renderer::progressive

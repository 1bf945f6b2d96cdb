// Tests the numbers of rays: those of the thesis in tables 4.2 and 4.7, and those published for the
// SPD.

#include <gtest/gtest.h>

#include "renderer/scene/generators.hpp"
#include "tests/renderer/support.hpp"

namespace renderer::test {
namespace {

void expect_within(double share, std::uint64_t found, double expected) {
  EXPECT_NEAR(static_cast<double>(found), expected, share * expected);
}

struct Row {
  int spheres;
  std::uint64_t total;
  // published tests per ray, for the Goldsmith-Salmon tree of another program
  double box_tests, sphere_tests;
};

class Spheres : public testing::TestWithParam<Row> {};

TEST_P(Spheres, RaysAndWork) {
  const Row& row = GetParam();
  const Params params = make_params(100, 100, 15, Traversal::exhaustive);
  const Rendering found = render(make_spheres(row.spheres), params);
  EXPECT_EQ(found.rays.total(), row.total);
  const double rays = static_cast<double>(found.rays.total());
  EXPECT_NEAR(static_cast<double>(found.work[Op::box_test]) / rays, row.box_tests,
              0.02 * row.box_tests);
  EXPECT_NEAR(static_cast<double>(found.work[Op::sphere_test]) / rays, row.sphere_tests,
              0.02 * row.sphere_tests);
  EXPECT_EQ(found.work[Op::ray_intersected], found.rays.total());
  EXPECT_EQ(found.work[Op::feeler_made], found.rays.shadow);
  EXPECT_EQ(found.work[Op::ray_reflected], found.rays.reflected);
  EXPECT_EQ(found.work[Op::polygon_test], found.rays.total()) << "the floor has no box of its own";
}

INSTANTIATE_TEST_SUITE_P(Thesis, Spheres,
                         testing::Values(Row{200, 54293, 14.4, 3.4}, Row{800, 59170, 20.6, 4.6},
                                         Row{3200, 62984, 29.2, 5.0}));

TEST(RayCounts, PublishedBalls) {
  Params params = make_params(513, 513, 5);
  params.feelers = Feelers::front;
  params.sample = SamplePosition::lattice;
  const RayCounts rays = render(make_spheres(7381), params).rays;
  EXPECT_EQ(rays.primary, 513u * 513u);
  EXPECT_EQ(rays.primary_hit, 263169u);
  expect_within(0.01, rays.reflected, 175095);
  EXPECT_EQ(rays.transmitted, 0u);
  expect_within(0.01, rays.shadow, 954368);
}

TEST(RayCounts, InfluenceEndsTreesAsDepthDoes) {
  // All reflectances are 0.5, so that rays on level 10 have the influence factor 0.5^9.
  Params params = make_params(40, 40, 10);
  const Scene scene = make_spheres(91);
  const RayCounts by_depth = render(scene, params).rays;
  params.limits = {1000, 0.0015};
  EXPECT_EQ(render(scene, params).rays, by_depth);
  params.limits = {1000, 0.003};
  EXPECT_LT(render(scene, params).rays.total(), by_depth.total());
}

TEST(RayCounts, FrontFeelersAreThoseThatMatter) {
  Params params = make_params(40, 40, 5);
  const Scene scene = make_random_scene(3, 25);
  const Rendering all = render(scene, params);
  params.feelers = Feelers::front;
  const Rendering front = render(scene, params);
  EXPECT_LT(front.rays.shadow, all.rays.shadow);
  EXPECT_EQ(front.samples, all.samples);
}

}  // namespace
}  // namespace renderer::test

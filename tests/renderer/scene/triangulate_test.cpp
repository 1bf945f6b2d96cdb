// Tests triangulations: the triangles must have the corners, the orientation and the area of the
// polygon, and must not overlap.
#include "renderer/scene/triangulate.hpp"

#include <gtest/gtest.h>

#include "tests/renderer/support.hpp"
#include "tests/support/files.hpp"

namespace renderer::test {
namespace {

double area_of(const std::vector<Vec>& corners, const Triangle& t) {
  const std::vector<Vec> part{corners[t[0]], corners[t[1]], corners[t[2]]};
  return dot(eval_area_normal(part), normalize(eval_area_normal(corners))) / 2;
}

// If all triangles have the polygon's orientation and their areas add up to its area, none of them
// overlap.
void expect_parts(const std::vector<Vec>& corners) {
  const auto triangles = triangulate(corners);
  EXPECT_EQ(triangles.size(), corners.size() - 2);
  const double whole = length(eval_area_normal(corners)) / 2;
  double sum = 0;
  for (const auto& triangle : triangles) {
    EXPECT_GE(area_of(corners, triangle), -1e-12 * whole);
    sum += area_of(corners, triangle);
  }
  EXPECT_NEAR(sum, whole, 1e-12 * whole);
}

TEST(Triangulate, StarsInAnyPlaneFlatOrBent) {
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    Random random{seed};
    auto star = make_star(random, random.point(10), 2);
    EXPECT_TRUE(is_flat(star));
    expect_parts(star);
    if (star.size() == 3) continue;
    const Vec bend = 0.02 * normalize(eval_area_normal(star));
    for (std::size_t i = 0; i < star.size(); i += 2) star[i] += bend;
    EXPECT_FALSE(is_flat(star));
    expect_parts(star);
  }
}

TEST(Triangulate, CornersOnAnEdgeAndBridgesToHoles) {
  expect_parts({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}});
  expect_parts({{0, 0, 0},
                {4, 0, 0},
                {4, 4, 0},
                {0, 4, 0},
                {0, 0, 0},
                {1, 1, 0},
                {1, 3, 0},
                {3, 3, 0},
                {3, 1, 0},
                {1, 1, 0}});
}

TEST(Triangulate, CrossedEdgesAreRefused) {
  const std::vector<Vec> crossed{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {2, 4, 0}};
  EXPECT_EQ(::test::message_of<base::BadInput>([&] { triangulate(crossed); }),
            "found a polygon with crossing edges, expected edges that do not cross");
  const std::vector<Vec> on_a_line{{0, 0, 0}, {1, 1, 0}, {2, 2, 0}, {1, 1, 0}};
  EXPECT_EQ(::test::message_of<base::BadInput>([&] { triangulate(on_a_line); }),
            "found a polygon with area 0, expected vertices that are not collinear");
}

}  // namespace
}  // namespace renderer::test

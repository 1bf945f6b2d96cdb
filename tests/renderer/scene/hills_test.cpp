// Tests the landscape of triangles: the triangles, their mesh, and the view.

#include "renderer/scene/hills.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "tests/renderer/support.hpp"

namespace renderer::test {
namespace {

using TriangleCorners = std::array<Vec, 3>;

// The triangles in the order of the scene.
std::vector<TriangleCorners> get_triangles(const Scene& scene) {
  std::vector<TriangleCorners> triangles;
  for (const Place place : scene.objects) {
    const Polygon& p = place.kind() == Kind::patch
                           ? static_cast<const Polygon&>(scene.patches[place.index()])
                           : scene.polygons[place.index()];
    EXPECT_EQ(p.count, 3u);
    EXPECT_GT(p.normal.z, 0);
    const auto at = [&](std::uint32_t i) { return eval_corner(p, scene.corners[p.first + i]); };
    triangles.push_back({at(0), at(1), at(2)});
  }
  return triangles;
}

// Rounds a point, because the corners that neighbours share are equal only up to rounding.
std::array<std::int64_t, 3> round_point(const Vec& p) {
  return {std::llround(p.x * 1e8), std::llround(p.y * 1e8), std::llround(p.z * 1e8)};
}

// The sides of the ground are at |x| = SLOPE * (y + 1.4).
constexpr double FRONT = -0.2, BACK = 41.7, SLOPE = 0.6;

bool is_on_outline(const Vec& p) {
  return std::abs(p.y - FRONT) < 1e-9 || p.y > BACK ||
         std::abs(std::abs(p.x) - SLOPE * (p.y + 1.4)) < 1e-7;
}

TEST(Hills, AreOneNetWithoutCracks) {
  for (const int n : {2, 3, 4, 5, 7, 24, 97, 1000, 3001, 20000}) {
    SCOPED_TRACE(n);
    const auto triangles = get_triangles(make_hills(n));
    ASSERT_EQ(triangles.size(), static_cast<std::size_t>(n));
    using Point = std::array<std::int64_t, 3>;
    std::set<Point> points;
    // for each edge: its two ends, once for every triangle that has the edge
    std::map<std::pair<Point, Point>, std::vector<Vec>> sides;
    double area = 0, back = 0;
    for (const TriangleCorners& t : triangles) {
      area += cross(t[1] - t[0], t[2] - t[0]).z / 2;
      for (int i = 0; i < 3; ++i) {
        const Vec &a = t[i], &b = t[(i + 1) % 3];
        EXPECT_TRUE(a.z > -1e-9 && a.z < 15 && a.y > FRONT - 1e-9) << a.z;
        EXPECT_LT(std::abs(a.x), SLOPE * (a.y + 1.4) + 1e-9);
        back = std::max(back, a.y);
        points.insert(round_point(a));
        auto& ends = sides[std::minmax(round_point(a), round_point(b))];
        ends.insert(ends.end(), {a, b});
      }
    }
    for (const auto& [edge, ends] : sides) {
      if (ends.size() == 4) {
        // the second triangle traverses the edge in the opposite direction
        EXPECT_EQ(round_point(ends[0]), round_point(ends[3]));
      } else {
        ASSERT_EQ(ends.size(), 2u);
        EXPECT_TRUE(is_on_outline(ends[0]) && is_on_outline(ends[1])) << ends[0].x << ends[0].y;
      }
    }
    EXPECT_EQ(points.size() + triangles.size(), sides.size() + 1);  // Euler's formula for a disc
    const double depth = back - FRONT;
    // if triangles do not overlap, their areas add up to that of the outline
    EXPECT_NEAR(area, depth * SLOPE * (2 * (FRONT + 1.4) + depth), 1e-6);
  }
}

TEST(Hills, WaterIsLevelAndMirrorsLandIsSmooth) {
  const Scene scene = make_hills(20000);
  int mirrors = 0, splinters = 0;
  for (const Polygon& p : scene.polygons) {
    const bool is_water = scene.surfaces[p.tag.surface].ks > 0;
    ++(is_water ? mirrors : splinters);
    if (!is_water) continue;
    EXPECT_NEAR(p.normal.z, 1, 1e-15);
    EXPECT_EQ(p.offset, 0);
  }
  EXPECT_GT(mirrors, 1000);
  EXPECT_LT(splinters, 100);
  std::set<std::uint32_t> covers;
  for (const Patch& p : scene.patches) {
    covers.insert(p.tag.surface);
    EXPECT_EQ(scene.surfaces[p.tag.surface].ks, 0);
    for (std::uint32_t i = 0; i < 3; ++i) EXPECT_GT(dot(scene.normals[p.normals + i], p.normal), 0);
  }
  EXPECT_EQ(covers.size(), 5u);
}

TEST(Hills, TheViewIsAboveTheGround) {
  for (const int n : {2, 50, 2000, 20000}) {
    const Scene scene = make_hills(n);
    Ray down;
    down.origin = scene.view.from;
    down.direction = {0, 0, -1};
    Work work;
    const auto hit = intersect(scene, down, Traversal::nearest, work);
    ASSERT_TRUE(hit);
    EXPECT_GT(hit->distance, 0.5) << n;
  }
}

// The numbers must be equal on every host and with every compiler.
TEST(Hills, ThePicture) {
  Params params;
  params.width = params.height = 64;
  const Rendering seen = render(make_hills(2000), params);
  EXPECT_EQ(seen.rays.primary_hit, 3355u);
  EXPECT_EQ(seen.rays.reflected, 1030u);
  EXPECT_EQ(seen.rays.shadow, 7610u);
  Samples::Sums sum;
  for (const auto& s : seen.samples.sums) sum = {sum.r + s.r, sum.g + s.g, sum.b + s.b};
  EXPECT_EQ(sum, (Samples::Sums{6092193731878, 7886623860933, 8233330943566}))
      << sum.r << ", " << sum.g << ", " << sum.b;
}

}  // namespace
}  // namespace renderer::test

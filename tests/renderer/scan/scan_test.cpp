// Tests the scan conversion of polygons by comparison with rays through the same samples.
#include "renderer/scan/scan.hpp"

#include <gtest/gtest.h>

#include "tests/renderer/support.hpp"

namespace renderer::test {
namespace {

constexpr int SCREEN_SIDE = 24;
constexpr Area ALL{0, 0, SCREEN_SIDE, SCREEN_SIDE};

// A view from the origin, whose samples are the lattice of SCREEN_SIDE x SCREEN_SIDE points.
struct Eye {
  View view;
  Params params = make_params(SCREEN_SIDE, SCREEN_SIDE, 1);
  Raster raster;
  explicit Eye(SamplePosition sample = SamplePosition::center) {
    view.from = {0, 0, 0};
    view.at = {0, 0, -1};
    view.angle = 70;
    view = make_image_plane(view);
    params.sample = sample;
    raster = make_raster(view, params);
  }
};

using ScannedCorners = std::vector<Scanner<1>::Corner>;

// The corners of a polygon. `value` returns the value at a corner.
template <class Value>
ScannedCorners make_corners(const View& view, const std::vector<Vec>& points, const Value& value) {
  ScannedCorners corners;
  for (const Vec& p : points) corners.push_back({to_eye(view, p), {value(p)}});
  return corners;
}

double no_value(const Vec&) { return 0; }

TEST(Scan, CoversWhatRaysMeet) {
  int behind = 0, covered = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    const Eye eye(static_cast<SamplePosition>(seed % 3));
    Scene scene;
    scene.view = eye.view;
    scene.surfaces.push_back({});
    const auto star = make_star(random, Vec{0, 0, -1} + random.point(2), 3);
    add_polygon(scene, star);
    finish(scene);
    behind += std::ranges::any_of(star, [](const Vec& p) { return p.z > 0; });
    // Interpolates the distance of the plane along the axis. This distance is also linear in space.
    std::vector<double> found(SCREEN_SIDE * SCREEN_SIDE), nearness(SCREEN_SIDE * SCREEN_SIDE);
    Scanner<1> scanner(eye.raster, ALL);
    std::vector<Vec> flat;
    for (const Corner3& c : scene.corners) flat.push_back(eval_corner(scene.polygons[0], c));
    scanner.scan(make_corners(eye.view, flat, [](const Vec& p) { return p.x; }),
                 [&](int x, int y, double near, const auto& values) {
                   EXPECT_EQ(nearness[std::size_t(y * SCREEN_SIDE + x)], 0) << "covered twice";
                   nearness[std::size_t(y * SCREEN_SIDE + x)] = near;
                   found[std::size_t(y * SCREEN_SIDE + x)] = values[0];
                 });
    Work work;
    for (int y = 0; y < SCREEN_SIDE; ++y)
      for (int x = 0; x < SCREEN_SIDE; ++x) {
        const auto at = std::size_t(y * SCREEN_SIDE + x);
        const auto hit =
            intersect(scene, make_primary(eye.view, eye.params, x, y), Traversal::linear, work);
        ASSERT_EQ(nearness[at] > 0, hit.has_value()) << x << ", " << y;
        if (!hit) continue;
        ++covered;
        EXPECT_NEAR(nearness[at] * -hit->point.z, 1, 1e-10);
        EXPECT_NEAR(found[at], hit->point.x, 1e-10 * (1 + std::abs(hit->point.x)));
      }
  }
  EXPECT_GT(behind, 50);
  EXPECT_GT(covered, 10000);
}

TEST(Scan, NeighboursShareNoSampleAndLeaveNoneOut) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    const Eye eye(SamplePosition::corner);
    // A fan of triangles around a point must cover every sample exactly once. The point is often
    // exactly on the ray of a sample.
    const Vec middle = seed % 2 ? Vec{0, 0, -1} : Vec{random.range(-1, 1), random.range(-1, 1), -1};
    std::vector<Vec> ring;
    const double start = random.unit();
    for (int i = 0; i < 7; ++i) {
      const double angle = start + 2 * std::numbers::pi * i / 7;
      ring.push_back({50 * std::cos(angle), 50 * std::sin(angle), random.range(-2, -0.5)});
    }
    std::vector<int> times(SCREEN_SIDE * SCREEN_SIDE);
    Scanner<1> scanner(eye.raster, ALL);
    for (std::size_t i = 0; i < ring.size(); ++i)
      scanner.scan(
          make_corners(eye.view, {middle, ring[i], ring[(i + 1) % 7]}, no_value),
          [&](int x, int y, double, const auto&) { ++times[std::size_t(y * SCREEN_SIDE + x)]; });
    EXPECT_EQ(std::ranges::count(times, 1), SCREEN_SIDE * SCREEN_SIDE);
  }
}

TEST(Scan, ValuesAreLinearInSpace) {
  // The value grows linearly from 0 to 1 along a floor that is one unit below the eye and recedes
  // from it.
  const Eye eye;
  Scanner<1> scanner(eye.raster, ALL);
  int count = 0;
  scanner.scan(make_corners(eye.view, {{-9, -1, -1}, {9, -1, -1}, {9, -1, -11}, {-9, -1, -11}},
                            [](const Vec& p) { return (-1 - p.z) / 10; }),
               [&](int, int, double nearness, const auto& values) {
                 EXPECT_NEAR(values[0], (1 / nearness - 1) / 10, 1e-12);
                 ++count;
               });
  EXPECT_GT(count, 50);
}

TEST(Scan, StaysInItsArea) {
  const Eye eye;
  const Area area{3, 5, 7, 4};
  Scanner<1> scanner(eye.raster, area);
  int count = 0;
  const auto put = [&](int x, int y, double, const auto&) {
    EXPECT_TRUE(x >= 3 && x < 10 && y >= 5 && y < 9) << x << ", " << y;
    ++count;
  };
  const auto wall =
      make_corners(eye.view, {{-9, -9, -1}, {9, -9, -1}, {9, 9, -1}, {-9, 9, -1}}, no_value);
  scanner.scan(wall, put);
  EXPECT_EQ(count, 28);
  count = 0;
  scanner.draw_line(wall[0], wall[2], put);
  EXPECT_EQ(count, 0);  // the diagonal from bottom to top passes through the samples (x, 23 - x)
  scanner.draw_line(wall[1], wall[3], put);
  EXPECT_EQ(count, 4);  // the samples from (5, 5) to (8, 8)
}

TEST(Scan, LinesBehindTheEyeAreCutOff) {
  const Eye eye;
  Scanner<1> scanner(eye.raster, ALL);
  std::vector<std::pair<int, int>> found;
  const auto put = [&](int x, int y, double nearness, const auto&) {
    EXPECT_GT(nearness, 0);
    found.emplace_back(x, y);
  };
  scanner.draw_line({{0, 0, -1}, {}}, {{1, 0, -1}, {}}, put);
  EXPECT_TRUE(found.empty());
  // The line leads from a point straight ahead to a point behind the eye, on the right.
  scanner.draw_line({{0.001, 0.01, 1}, {}}, {{1, 0.01, -1}, {}}, put);
  ASSERT_EQ(found.size(), 12u);
  EXPECT_EQ(found.front().first, 12);
  EXPECT_EQ(found.back().first, 23);
}

}  // namespace
}  // namespace renderer::test

// Compares the form factors of eval_factor() with those of two independent calculations.

#include <gtest/gtest.h>

#include "tests/renderer/radiosity/light/closed_forms.hpp"
#include "tests/renderer/radiosity/light/hemisphere.hpp"

namespace radiosity::test {
namespace {

// Polygons are anywhere, even partly below the horizon. There are no obstacles.
TEST(TwoCalculators, AgreeWithLambertOnPolygons) {
  double worst = 0, worst_fine = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    Room room;
    room.materials = {{"lamp", grey(0), grey(1)}};
    Face face;
    face.corners =
        make_ring(random.point(1), random.direction(), random.range(0.1, 1), 3 + random.below(6));
    room.faces = {face};
    const Mesh mesh = make_mesh(room, {});
    const Vertex point = make_point(random.point(1), random.direction());
    // skips points behind the polygon or in its plane
    if (dot(mesh.patches[0].normal, point.at - face.corners[0]) < 0.01) continue;
    const double exact = closed::polygon(point.at, point.normal, face.corners);
    const double error = sum_factors({mesh, {}}, point) - exact;
    const double fine = sum_factors({mesh, {.spread = 0.05}}, point) - exact;
    EXPECT_LT(std::abs(error), 0.01 * exact + 0.004);
    EXPECT_LT(std::abs(fine), 0.002 * exact + 0.0005);
    worst = std::max(worst, std::abs(error));
    worst_fine = std::max(worst_fine, std::abs(fine));
  }
  fmt::print("largest error {:.5f}, with delta areas of 0.05 {:.5f}\n", worst, worst_fine);
}

// Compares the factors of both sides of every face, for all vertices, in rooms with obstacles.
TEST(TwoCalculators, AgreeWithHemispheresInFurnishedRooms) {
  double worst = 0, worst_fine = 0, sum = 0, sum_fine = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Random random{seed};
    const Room room = make_furnished(random, 4, 1 + random.below(2));
    const Mesh mesh = make_mesh(room, {});
    for (int i = 0; i < 6; ++i) {
      const auto v = static_cast<std::size_t>(random.below(static_cast<int>(mesh.vertices.size())));
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", vertex " << v);
      const Vertex& vertex = mesh.vertices[v];
      const auto expected = eval_hemisphere(mesh, vertex, 128, random);
      const auto found = eval_sides({mesh, {}}, vertex, room);
      const auto fine = eval_sides({mesh, {.spread = 0.05}}, vertex, room);
      const auto compare = [&](const auto& calculated, double& most, double& squares, double by) {
        std::map<Side, double> difference = expected;
        for (const auto& [side, share] : calculated) difference[side] -= share;
        for (const auto& [side, error] : difference) {
          EXPECT_LT(std::abs(error), by) << "face " << side.first << ", front " << side.second;
          most = std::max(most, std::abs(error));
          squares += error * error;
        }
      };
      compare(found, worst, sum, 0.03);
      compare(fine, worst_fine, sum_fine, 0.006);
    }
  }
  EXPECT_LT(sum_fine, sum / 4);
  fmt::print("largest difference {:.5f}, with delta areas of 0.05 {:.5f}\n", worst, worst_fine);
}

}  // namespace
}  // namespace radiosity::test

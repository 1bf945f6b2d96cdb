// Tests that a mirror shows what a window into the unfolded room would show. With
// FactorParams::mirror_pieces = 0, the light via mirrors must equal that of the unfolded room to a
// millionth for any patch size, if mirror_share has no effect and delta areas are therefore halved
// as in direct view. The only exceptions are delta areas whose centre lies on the edge of a mirror
// or an object.

#include <gtest/gtest.h>

#include "tests/renderer/radiosity/light/unfold.hpp"

namespace radiosity::test {
namespace {

using Chains = std::vector<std::vector<MirrorPlane>>;

void expect_images(const Room& room, const Chains& chains, FactorParams params,
                   double most = 0.02) {
  params.mirror_share = 1e9;  // has no effect: delta areas are halved as in direct view
  const Room unfolded = unfold(room, chains);
  const std::size_t faces = unfolded.faces.size() / (chains.size() + 1);
  const Mesh mesh = make_mesh(room, {}), images = make_mesh(unfolded, {});
  std::size_t compared = 0, differ = 0;
  double sum = 0, error = 0;
  for (const Vertex& vertex : mesh.vertices) {
    const auto found = eval_by_mirrors({mesh, params}, vertex, faces);
    const auto expected = eval_by_images({images, params}, vertex, faces);
    for (std::size_t f = 0; f < faces; ++f, ++compared) {
      // the rays for visibility aim slightly beside the centres
      differ += std::abs(found[f] - expected[f]) > 1e-6;
      EXPECT_NEAR(found[f], expected[f], most) << "face " << f;
      error += std::abs(found[f] - expected[f]);
      sum += expected[f];
    }
  }
  EXPECT_LT(error / sum, 0.003);
  EXPECT_LT(static_cast<double>(differ), 0.1 * static_cast<double>(compared));
  fmt::print("{} of {} differ, by {:.6f} in the mean\n", differ, compared, error / sum);
}

TEST(MirrorImages, OfAWholeWall) {
  for (const bool things : {false, true}) {
    Room room = make_cube("xyYzZ", things, 2);
    add_walls(room, "X", 1, 2);
    expect_images(room, {{HIGH_X}}, {.reflections = 1});
  }
}

// A part of the wall is a mirror. In the unfolded room, the rest of the wall remains as an
// obstacle.
TEST(MirrorImages, OfAPartOfAWall) {
  Room room = make_cube("xyYzZ", true, 2);
  const Vec at{2, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  add_quad(room, 0, at, 0.5 * z, 2 * y);
  add_quad(room, 0, at + 1.5 * z, 0.5 * z, 2 * y);
  add_quad(room, 0, at + 0.5 * z, z, 0.7 * y);
  add_quad(room, 0, at + 0.5 * z + 1.3 * y, z, 0.7 * y);
  add_quad(room, 2, at + 0.5 * z + 0.7 * y, z, 0.6 * y);
  expect_images(room, {{HIGH_X}}, {.reflections = 1});
}

// Two mirrors give three images. The third image is seen in both mirrors, behind their common edge.
// Light from one half of it meets one mirror first, light from the other half the other mirror.
// (Light exactly behind the edge is lost, because its path meets no mirror there. Points on the
// diagonal of this room do see such delta areas.)
TEST(MirrorImages, OfTwoAtRightAngles) {
  Room room = make_cube("xyzZ", true, 2);
  add_walls(room, "XY", 1, 2);
  expect_images(room, {{HIGH_X}, {HIGH_Y}, {HIGH_X, HIGH_Y}}, {.reflections = 2}, 0.03);
}

TEST(MirrorImages, OfTwoFaceToFace) {
  for (const int reflections : {1, 3, MOST_REFLECTIONS}) {
    Room room = make_cube("zZyY", reflections == 3, 1);
    add_walls(room, "xX", 1, 2);
    Chains chains;
    for (int depth = 1; depth <= reflections; ++depth) {
      std::vector<MirrorPlane> one, other;
      for (int k = 0; k < depth; ++k) {
        one.push_back(k % 2 == 0 ? HIGH_X : LOW_X);
        other.push_back(k % 2 == 0 ? LOW_X : HIGH_X);
      }
      chains.push_back(one);
      chains.push_back(other);
    }
    expect_images(room, chains, {.reflections = reflections});
  }
}

// Solves the room with a mirror, and the unfolded room without mirrors. With smaller delta areas,
// the two solutions must converge at every vertex.
TEST(MirrorImages, HaveTheRoomsRadiosity) {
  Room room = make_cube("xyYzZ", true, 2);
  add_walls(room, "X", 1, 2);
  const Mesh mesh = make_mesh(room, {}), images = make_mesh(unfold(room, {{HIGH_X}}), {});
  double last_worst = 1, last_mean = 1;
  for (const double spread : {0.4, 0.2, 0.1}) {
    const auto params = make_params(1e-2, {.spread = spread, .reflections = 1});
    const Solution found = solve(mesh, params), expected = solve(images, params);
    double worst = 0, mean = 0;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      ASSERT_EQ(mesh.vertices[v].at, images.vertices[v].at);
      ASSERT_EQ(mesh.vertices[v].normal, images.vertices[v].normal);
      const double error = std::abs(found.vertices[v].g / expected.vertices[v].g - 1);
      worst = std::max(worst, error);
      mean += error / static_cast<double>(mesh.vertices.size());
    }
    fmt::print("spread {}: worst {:.5f}, mean {:.5f}\n", spread, worst, mean);
    EXPECT_LT(worst, last_worst / 2);
    EXPECT_LT(mean, 0.6 * last_mean);
    last_worst = worst;
    last_mean = mean;
  }
  EXPECT_LT(last_worst, 0.01);
}

}  // namespace
}  // namespace radiosity::test

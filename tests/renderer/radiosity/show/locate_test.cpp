// Tests the location of the patch at a point of a face.
#include "renderer/radiosity/show/locate.hpp"

#include <gtest/gtest.h>

#include "renderer/radiosity/mesh/divide.hpp"
#include "tests/renderer/radiosity/show/pictures.hpp"

namespace radiosity::test {
namespace {

// A convex quad: four points on a circle that is stretched and rotated. A side may have length
// zero.
std::array<Corner, 4> make_quad(Random& random) {
  std::array<double, 4> angles;
  for (double& a : angles) a = random.range(0, 2 * std::numbers::pi);
  std::ranges::sort(angles);
  const double squeeze = random.range(0.05, 1), shear = random.range(-1, 1);
  std::array<Corner, 4> quad;
  for (std::size_t k = 0; k < 4; ++k) {
    const double u = std::cos(angles[k]), v = squeeze * std::sin(angles[k]);
    quad[k] = {3 + u + shear * v, v - 2};
  }
  if (random.below(4) == 0) quad[1] = quad[0];
  if (random.below(2) == 0) std::ranges::reverse(quad);
  return quad;
}

TEST(InvertBilinear, FindsWhatAPointWasMadeOf) {
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    Random random{seed};
    const auto quad = make_quad(random);
    const double s = random.unit(), t = random.unit();
    const auto eval = [&](double s_, double t_) {
      const double weights[] = {(1 - s_) * (1 - t_), s_ * (1 - t_), s_ * t_, (1 - s_) * t_};
      Corner sum;
      for (std::size_t k = 0; k < 4; ++k)
        sum = {sum.u + weights[k] * quad[k].u, sum.v + weights[k] * quad[k].v};
      return sum;
    };
    const Corner point = eval(s, t), found = invert_bilinear(quad, point),
                 again = eval(found.u, found.v);
    EXPECT_NEAR(again.u, point.u, 1e-7) << "seed " << seed;
    EXPECT_NEAR(again.v, point.v, 1e-7) << "seed " << seed;
    EXPECT_GE(std::min(found.u, found.v), -1e-6) << "seed " << seed;
    EXPECT_LE(std::max(found.u, found.v), 1 + 1e-6) << "seed " << seed;
  }
}

TEST(InvertBilinear, ParallelogramsToTheLastBits) {
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    Random random{seed};
    const Corner a{random.range(-5, 5), random.range(-5, 5)}, e{random.range(0.1, 1), 0.03},
        f{0.02, random.range(0.1, 1)};
    const Corner found = invert_bilinear(
        {{a, {a.u + e.u, a.v + e.v}, {a.u + e.u + f.u, a.v + e.v + f.v}, {a.u + f.u, a.v + f.v}}},
        {a.u + 0.25 * e.u + 0.75 * f.u, a.v + 0.25 * e.v + 0.75 * f.v});
    EXPECT_NEAR(found.u, 0.25, 1e-13) << "seed " << seed;
    EXPECT_NEAR(found.v, 0.75, 1e-13) << "seed " << seed;
  }
}

TEST(Locate, EveryPointOfEverySideIsOnItsPatch) {
  for (const int refine : {1, 5}) {
    Room room = make_furnished_cube(2);
    room.creases = {{{0.1, 0, 0.15}, {0.8, 0, 0.9}}, {{0.5, 0, 0.1}, {0.45, 0, 0.95}}};
    const Mesh mesh = make_mesh(room, {refine});
    const Sides sides = make_sides(mesh);
    Random random{7};
    renderer::Work work;
    for (std::uint32_t object = 0; object < room.faces.size(); ++object)
      for (const bool back : {false, true}) {
        const auto& face = room.faces[object];
        const auto& side = get_side(sides, object, back);
        ASSERT_EQ(side.kind == radiosity::Side::Kind::nothing, back && !face.two_sided);
        for (int i = 0; i < 200 && side.kind == radiosity::Side::Kind::patches; ++i) {
          // Some points lie on corners and edges of patches.
          Vec point;
          double sum = 0;
          for (const Vec& corner : face.corners) {
            const double weight = random.below(3) == 0 ? 0 : random.unit();
            point += weight * corner;
            sum += weight;
          }
          point = sum > 0 ? (1 / sum) * point : face.corners[0];
          const Spot spot = locate(mesh, side, object, point, work);
          const Patch& patch = mesh.patches[spot.patch];
          EXPECT_EQ(patch.face, object);
          EXPECT_EQ(dot(patch.normal, eval_area_normal(face.corners)) < 0, back);
          std::array<Vec, 4> corners;
          for (std::size_t k = 0; k < 4; ++k) corners[k] = mesh.vertices[patch.corners[k]].at;
          EXPECT_LT(length(eval_bilinear(corners, spot.s, spot.t) - point), 1e-7)
              << "face " << object << " point " << i;
        }
      }
    // The grid must test only one or a few patches for each point, not all of them.
    EXPECT_LT(work[renderer::Op::polygon_edges], 200 * 12 * 6u);
  }
}

}  // namespace
}  // namespace radiosity::test

// Tests form factors in closed rooms. A vertex sees only patches, so that its form factors sum to
// 1. Form factors are reciprocal: the two factors between a pair of patches are in the ratio of the
// patches' areas.

#include <gtest/gtest.h>

#include "tests/renderer/radiosity/support.hpp"

namespace radiosity::test {
namespace {

struct Range {
  double lo = 1e9, hi = -1e9;
  void add(double value) {
    lo = std::min(lo, value);
    hi = std::max(hi, value);
  }
};

// The range of the sums of form factors, over every vertex or only every `step`-th one.
Range sum_all(const Mesh& mesh, const FactorParams& params, std::size_t step = 1) {
  Range sums;
  for (std::size_t v = 0; v < mesh.vertices.size(); v += step)
    sums.add(sum_factors({mesh, params}, mesh.vertices[v]));
  return sums;
}

TEST(ClosedRoom, FactorsOfAVertexSumToOne) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    Room room;
    room.materials = {{"wall", grey(0.5), grey(1)}};
    const Vec size{random.range(1, 5), random.range(1, 5), random.range(1, 5)};
    add_box(room, 0, {0, 0, 0}, size, 1 + random.below(4));
    const Mesh mesh = make_mesh(room, {});
    const Range sums = sum_all(mesh, {}), fine = sum_all(mesh, {.spread = 0.09}, 7);
    EXPECT_GT(sums.lo, 0.99);
    EXPECT_LT(sums.hi, 1.01);
    EXPECT_GT(fine.lo, 0.9975);
    EXPECT_LT(fine.hi, 1.0025);
  }
}

// A delta area counts as visible or hidden as a whole. One that is partly hidden therefore counts
// too much or too little.
TEST(ClosedRoom, FactorsSumToOneWithThingsInside) {
  Range all, all_fine;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    const Mesh mesh = make_mesh(make_furnished(random, 3, 2), {});
    double total = 0;
    for (const Vertex& vertex : mesh.vertices) {
      const double sum = sum_factors({mesh, {}}, vertex);
      all.add(sum);
      total += sum / static_cast<double>(mesh.vertices.size());
    }
    EXPECT_NEAR(total, 1, 0.01);
    const Range fine = sum_all(mesh, {.spread = 0.05}, 17);
    all_fine.add(fine.lo);
    all_fine.add(fine.hi);
  }
  EXPECT_GT(all.lo, 0.95);
  EXPECT_LT(all.hi, 1.05);
  EXPECT_GT(all_fine.lo, 0.99);
  EXPECT_LT(all_fine.hi, 1.01);
  fmt::print("sums {:.4f} to {:.4f}, with delta areas of 0.05 {:.4f} to {:.4f}\n", all.lo, all.hi,
             all_fine.lo, all_fine.hi);
}

// Takes the mean over 6 x 6 points of the receiving patch. The mean of its four vertices would be
// accurate only for patches that are small compared with their distance.
TEST(ClosedRoom, FactorsAreReciprocal) {
  double worst = 0, worst_corners = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Random random{seed};
    const Mesh mesh = make_mesh(make_furnished(random, 2, 3), {});
    const Eye eye{mesh, {.spread = 0.1}};
    for (int k = 0; k < 40; ++k) {
      const auto pick = [&] {
        const auto count = static_cast<int>(mesh.patches.size());
        return static_cast<std::size_t>(random.below(count));
      };
      const std::size_t i = pick(), j = pick();
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", patches " << i << " and " << j);
      const Patch &one = mesh.patches[i], &other = mesh.patches[j];
      Work work;
      const auto exchange = [&](const Patch& to, const Patch& from) {
        return to.area * eval_mean(mesh, to, 6, [&](const Vertex& point) {
                 return eval_factor(eye, point, from, work);
               });
      };
      const double there = exchange(one, other), back = exchange(other, one);
      const double scale = std::min(one.area, other.area);
      EXPECT_NEAR(there, back, 0.01 * scale);
      worst = std::max(worst, std::abs(there - back) / scale);
      const auto by_corners = [&](const Patch& to, const Patch& from) {
        double mean = 0;
        for (const auto v : to.corners) mean += eval_factor(eye, mesh.vertices[v], from, work) / 4;
        return to.area * mean;
      };
      const double distance = length(one.centre - other.centre);
      if (std::max(one.area, other.area) > 0.1 * distance * distance) continue;
      const double error = std::abs(by_corners(one, other) - by_corners(other, one)) / scale;
      EXPECT_LT(error, 0.02);
      worst_corners = std::max(worst_corners, error);
    }
  }
  EXPECT_GT(worst_corners, 0) << "no two patches are far from each other";
  fmt::print("of the smaller patch's hemisphere: {:.5f}, by corners {:.5f}\n", worst,
             worst_corners);
}

}  // namespace
}  // namespace radiosity::test

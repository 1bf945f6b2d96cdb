// Increasing realism in IIRRA: the order of cells, and the next step of a cell.
#include "simulator/iirra/tasks/realism.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

namespace iirra {
namespace {

using renderer::Area;

constexpr int SAMPLES[] = {0, 5, 9, 13};  // number of samples in a cell, by sampling level

// --- Bayer's matrix -----------------------------------------------------------------------------

TEST(IirraOrder, BayersMatrixIsThatOfEq57) {
  const std::uint64_t expected[4][4] = {
      {1, 9, 3, 11}, {13, 5, 15, 7}, {4, 12, 2, 10}, {16, 8, 14, 6}};
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) EXPECT_EQ(eval_bayer(x, y, 2) + 1, expected[y][x]) << x << " " << y;
}

TEST(IirraOrder, BayersMatrixHasEachNumberOnce) {
  for (int bits = 0; bits <= 5; ++bits) {
    const int side = 1 << bits;
    std::set<std::uint64_t> found;
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) found.insert(eval_bayer(x, y, bits));
    const auto count = std::uint64_t{1} << 2 * bits;
    EXPECT_EQ(found.size(), count);
    EXPECT_EQ(*found.rbegin(), count - 1);
  }
}

// In Bayer's matrix, the first 4, 16 or 64 elements must be spread evenly: if the matrix is divided
// into as many equal blocks, each block has one of them.
TEST(IirraOrder, BayersMatrixIsEvenAtAnyTime) {
  for (const int drawn : {4, 16, 64}) {
    const int block = 16 / (drawn == 4 ? 2 : drawn == 16 ? 4 : 8);
    std::set<std::pair<int, int>> blocks;
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x)
        if (eval_bayer(x, y, 4) < static_cast<std::uint64_t>(drawn))
          blocks.insert({x / block, y / block});
    EXPECT_EQ(blocks.size(), static_cast<std::size_t>(drawn));
  }
}

// --- choice of the next step -------------------------------------------------------------------

Quantities waiting(double contrast, int depth, double influence) {
  return {contrast, depth, influence};
}

TEST(IirraAdvance, WithoutLimitsResolutionComesUntilItIsAllThere) {
  const Quantities none{};
  for (const int side : {4, 16}) {
    for (const int level : {0, 1, 2})
      EXPECT_EQ(choose({0, 0, side, level}, none, {}), Advance::sample);
    EXPECT_EQ(choose({0, 0, side, 3}, none, {}), Advance::divide);
  }
  EXPECT_EQ(choose({0, 0, 2, 0}, none, {}), Advance::sample);
  EXPECT_EQ(choose({0, 0, 2, 1}, none, {}), Advance::sample);
  EXPECT_EQ(choose({0, 0, 2, 2}, none, {}), Advance::none);
}

TEST(IirraAdvance, ContrastIsWeighedAgainstInfluence) {
  const SampledCell cell{0, 0, 8, 2};
  EXPECT_EQ(choose(cell, waiting(0.5, 2, 0.6), {}), Advance::deepen);
  EXPECT_EQ(choose(cell, waiting(0.6, 2, 0.6), {}), Advance::sample);
  EXPECT_EQ(choose({0, 0, 8, 3}, waiting(0.7, 2, 0.6), {}), Advance::divide);
  EXPECT_EQ(choose({0, 0, 2, 2}, waiting(0.7, 2, 0.6), {}), Advance::deepen);
}

TEST(IirraAdvance, EachLimitForbidsItsAdvance) {
  Limits cells;
  cells.min_cell = 8;
  EXPECT_EQ(choose({0, 0, 16, 3}, {}, cells), Advance::divide);
  EXPECT_EQ(choose({0, 0, 8, 2}, {}, cells), Advance::sample);
  EXPECT_EQ(choose({0, 0, 8, 3}, {}, cells), Advance::none);
  EXPECT_EQ(choose({0, 0, 4, 1}, {}, cells), Advance::none);
  EXPECT_EQ(choose({0, 0, 8, 3}, waiting(1, 2, 0.1), cells), Advance::deepen);

  Limits samples;
  samples.max_samples = 8;
  EXPECT_EQ(choose({0, 0, 8, 0}, {}, samples), Advance::sample);
  EXPECT_EQ(choose({0, 0, 8, 1}, {}, samples), Advance::none);
  samples.max_samples = 9;
  EXPECT_EQ(choose({0, 0, 8, 1}, {}, samples), Advance::sample);
  EXPECT_EQ(choose({0, 0, 8, 2}, {}, samples), Advance::none);
  EXPECT_EQ(choose({0, 0, 8, 2}, waiting(1, 2, 0.1), samples), Advance::deepen);

  Limits contrast;
  contrast.min_contrast = 0.3;
  EXPECT_EQ(choose({0, 0, 8, 3}, waiting(0.29, 0, 0), contrast), Advance::none);
  EXPECT_EQ(choose({0, 0, 8, 3}, waiting(0.3, 0, 0), contrast), Advance::divide);
  EXPECT_EQ(choose({0, 0, 8, 2}, waiting(0.29, 0, 0), contrast), Advance::sample);
}

TEST(IirraAdvance, NothingIsDoneOutsideTheAreaOfInterest) {
  Limits limits;
  limits.area = {20, 10, 5, 5};
  const auto chosen = [&](int x, int y) {
    return choose({x, y, 4, 0}, waiting(1, 1, 1), limits) != Advance::none;
  };
  EXPECT_TRUE(chosen(20, 10));
  EXPECT_TRUE(chosen(17, 7));  // the last pixel of this cell is the first of the area
  // Only the border of this cell lies in the area. The pixels on the border belong to the next
  // cell.
  EXPECT_FALSE(chosen(16, 10));
  EXPECT_FALSE(chosen(20, 6));
  EXPECT_TRUE(chosen(24, 14));
  EXPECT_FALSE(chosen(25, 14));
  EXPECT_FALSE(chosen(24, 15));
}

TEST(IirraAdvance, RaysHaveTheirLimits) {
  renderer::Ray ray;
  ray.influence = {0.1, 0.3, 0.2};
  ray.level = 4;
  Limits limits;
  EXPECT_TRUE(is_within(ray, limits));
  limits.min_influence = 0.31;
  EXPECT_FALSE(is_within(ray, limits));
  limits.min_influence = 0.3;
  limits.depth_reflected = 3;
  EXPECT_FALSE(is_within(ray, limits));
  ray.through = true;
  EXPECT_TRUE(is_within(ray, limits));
  limits.depth_transmitted = 3;
  limits.depth_reflected = 4;
  EXPECT_FALSE(is_within(ray, limits));
  ray.through = false;
  EXPECT_TRUE(is_within(ray, limits));
}

TEST(IirraAdvance, WithoutLimitsOnlyTheOrderStays) {
  Limits limits{0.5, 3, 4, 8, 9, 0.2, {1, 2, 3, 4}, Weights{1, 2, 3, 4, 5, 6}};
  Limits expected;
  expected.weights = limits.weights;
  EXPECT_EQ(without_limits(limits), expected);
}

Limits draw_limits(std::mt19937_64& random) {
  Limits limits;
  limits.min_cell = 1 << random() % 6;
  limits.max_samples = 5 + static_cast<int>(random() % 9);
  limits.min_contrast = static_cast<double>(random() % 5) / 4;
  if (random() % 2) limits.area = {4, 4, 10, 10};
  return limits;
}

Quantities random_quantities(std::mt19937_64& random) {
  const auto any = [&] { return static_cast<double>(random() % 5) / 4; };
  const int depth = static_cast<int>(random() % 4);
  const double contrast = any();
  return {contrast, depth, depth > 0 ? any() : 0};
}

// The chosen step must be possible and within the limits. Advance::none must be chosen only if no
// step is both possible and within the limits.
TEST(IirraAdvance, IsPossibleAndAllowed) {
  for (std::uint64_t seed = 1; seed <= 4000; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    const int side = 2 << random() % 5;
    const SampledCell cell{int(random() % 20), int(random() % 20), side,
                           int(random() % (side > 2 ? 4 : 3))};
    const auto quantities = random_quantities(random);
    const auto limits = draw_limits(random);
    const bool is_sampled = cell.level == (side > 2 ? 3 : 2);
    const bool is_inside = limits.area == Area{} ||
                           (cell.x < 14 && cell.x + side > 4 && cell.y < 14 && cell.y + side > 4);
    // The first level of the largest cells is always allowed, because nothing is known before it.
    const bool may_sample = is_inside && !is_sampled &&
                            (cell.level == 0 || (side >= limits.min_cell &&
                                                 SAMPLES[cell.level + 1] <= limits.max_samples));
    const bool may_divide = is_inside && is_sampled && side / 2 >= std::max(2, limits.min_cell) &&
                            quantities.contrast >= limits.min_contrast;
    const bool may_deepen = is_inside && quantities.depth > 0;
    switch (choose(cell, quantities, limits)) {
      case Advance::none:
        EXPECT_FALSE(may_sample || may_divide || may_deepen);
        break;
      case Advance::sample:
        EXPECT_TRUE(may_sample);
        break;
      case Advance::divide:
        EXPECT_TRUE(may_divide);
        break;
      case Advance::deepen:
        EXPECT_TRUE(may_deepen);
        break;
    }
  }
}

// Without limits, every cell must be finished after a number of steps, whatever its samples are.
// Then all its pixels are sampled, and no ray waits.
TEST(IirraAdvance, EndsWithoutLimits) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    struct Walker {
      SampledCell cell;
      int depth;
    };
    std::vector<Walker> walkers{{{0, 0, 16, 0}, 0}};
    int steps = 0, pixels = 0;
    constexpr int DEEPEST = 6;
    while (!walkers.empty()) {
      ASSERT_LT(++steps, 4000);
      Walker walker = walkers.back();
      walkers.pop_back();
      Quantities quantities = random_quantities(random);
      quantities.depth = walker.depth;
      switch (choose(walker.cell, quantities, {})) {
        case Advance::none:
          EXPECT_EQ(walker.cell.side, 2);
          EXPECT_EQ(walker.cell.level, 2);
          EXPECT_EQ(walker.depth, 0);
          pixels += 4;
          continue;
        case Advance::sample:
          ++walker.cell.level;
          if (random() % 2) walker.depth = std::max(walker.depth, 2);
          walkers.push_back(walker);
          break;
        case Advance::divide:
          for (const auto& daughter : divide(walker.cell))
            walkers.push_back({daughter, walker.depth});
          break;
        case Advance::deepen:
          walker.depth = walker.depth == DEEPEST || random() % 3 == 0 ? 0 : walker.depth + 1;
          walkers.push_back(walker);
          break;
      }
    }
    EXPECT_EQ(pixels, 16 * 16);
  }
}

// --- importance ---------------------------------------------------------------------------------

constexpr Weights NOTHING{0, 0, 0, 0, 0, 0};

struct Judged {
  SampledCell cell;
  Quantities quantities = {};
};

// Expects that, with only this weight different from 0, importance decreases from each cell to the
// next.
void expect_falling(double Weights::*weight, const std::vector<Judged>& cells,
                    const Limits& limits = {}) {
  Ordering ordering{{0, 0, 64, 64}, 16, CellOrder::bayer, 1, NOTHING};
  ordering.weights.*weight = 2;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const double sum = ordering.eval(cells[i].cell, cells[i].quantities, limits).sum;
    EXPECT_GE(sum, 0) << i;
    EXPECT_LE(sum, 2) << i;
    if (i == 0) continue;
    EXPECT_LT(sum, ordering.eval(cells[i - 1].cell, cells[i - 1].quantities, limits).sum) << i;
  }
}

TEST(IirraImportance, FollowsEachWeight) {
  expect_falling(&Weights::size, {{{0, 0, 16, 1}}, {{0, 0, 8, 1}}, {{0, 0, 4, 1}}, {{0, 0, 2, 1}}});
  expect_falling(&Weights::samples,
                 {{{0, 0, 8, 0}}, {{0, 0, 8, 1}}, {{0, 0, 8, 2}}, {{0, 0, 8, 3}}});
  expect_falling(
      &Weights::contrast,
      {{{0, 0, 8, 1}, {1, 0, 0}}, {{0, 0, 8, 1}, {0.5, 0, 0}}, {{0, 0, 8, 1}, {0, 0, 0}}});
  expect_falling(&Weights::depth, {{{0, 0, 8, 1}, {0, 1, 0}},
                                   {{0, 0, 8, 1}, {0, 2, 0}},
                                   {{0, 0, 8, 1}, {0, 9, 0}},
                                   {{0, 0, 8, 1}, {0, 0, 0}}});
  expect_falling(
      &Weights::influence,
      {{{0, 0, 8, 1}, {0, 2, 0.9}}, {{0, 0, 8, 1}, {0, 2, 0.1}}, {{0, 0, 8, 1}, {0, 0, 0}}});
  Limits limits;
  limits.area = {40, 40, 8, 8};
  expect_falling(&Weights::position,
                 {{{40, 40, 8, 1}}, {{24, 40, 8, 1}}, {{16, 40, 8, 1}}, {{0, 8, 8, 1}}}, limits);
}

TEST(IirraImportance, IsEqualWithinTheAreaOfInterest) {
  Limits limits;
  limits.area = {8, 8, 30, 30};
  Ordering ordering{{0, 0, 64, 64}, 16, CellOrder::bayer, 1, NOTHING};
  ordering.weights.position = 1;
  for (const auto& [x, y] : {std::pair(8, 8), {20, 16}, {36, 36}, {4, 4}})
    EXPECT_EQ(ordering.eval({x, y, 8, 1}, {}, limits).sum, 1);
  // Without an area of interest, the whole image is of interest.
  EXPECT_EQ(ordering.eval({0, 0, 2, 1}, {}, {}).sum, 1);
}

// The gap between a cell and the area of interest counts, on whatever side of the area the cell is.
TEST(IirraImportance, IsEqualOnOppositeSidesOfTheAreaOfInterest) {
  Limits limits;
  limits.area = {24, 20, 16, 24};
  Ordering ordering{{0, 0, 64, 64}, 16, CellOrder::bayer, 1, NOTHING};
  ordering.weights.position = 1;
  const auto eval = [&](int x, int y) { return ordering.eval({x, y, 8, 1}, {}, limits).sum; };
  for (const int gap : {1, 4, 12}) {
    const int left = 24 - gap - 8, right = 24 + 16 + gap, above = 20 - gap - 8,
              below = 20 + 24 + gap;
    EXPECT_DOUBLE_EQ(eval(left, 24), 1 - gap / std::hypot(64, 64));
    for (const auto& [x, y] : {std::pair(right, 24), {24, above}, {24, below}})
      EXPECT_EQ(eval(x, y), eval(left, 24)) << x << " " << y;
  }
}

TEST(IirraImportance, TheLimitsWeightsComeBeforeTheProgrammes) {
  const Ordering ordering{{0, 0, 64, 64}, 16, CellOrder::bayer, 1, {0, 1, 0, 0, 0, 0}};
  Limits limits;
  const SampledCell cell{0, 0, 16, 1};
  EXPECT_DOUBLE_EQ(ordering.eval(cell, {0.25, 0, 0}, limits).sum, 1);
  limits.weights = Weights{0, 0, 0, 3, 0, 0};
  EXPECT_DOUBLE_EQ(ordering.eval(cell, {0.25, 0, 0}, limits).sum, 0.75);
}

// Returns columns and rows of 4 x 4 cells, sorted by their place in the order. The image does not
// begin at the origin, so that the test notices if coordinates are not relative to the image.
std::vector<std::pair<int, int>> places(CellOrder order, std::uint64_t seed = 1) {
  const Ordering ordering{{3, 5, 64, 64}, 16, order, seed, {}};
  std::vector<std::pair<std::uint64_t, std::pair<int, int>>> all;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      all.push_back(
          {ordering.eval({3 + 16 * column, 5 + 16 * row, 16, 0}, {}, {}).place, {column, row}});
  std::ranges::sort(all);
  std::vector<std::pair<int, int>> cells;
  for (const auto& [place, cell] : all) cells.push_back(cell);
  return cells;
}

TEST(IirraImportance, OrdersCellsOfOneImportance) {
  using Cells = std::vector<std::pair<int, int>>;
  const auto first = [](Cells cells) { return Cells(cells.begin(), cells.begin() + 6); };
  EXPECT_EQ(first(places(CellOrder::bayer)),
            (Cells{{0, 0}, {2, 2}, {2, 0}, {0, 2}, {1, 1}, {3, 3}}));
  EXPECT_EQ(first(places(CellOrder::sequential)),
            (Cells{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {0, 1}, {1, 1}}));
  EXPECT_EQ(first(places(CellOrder::recursive)),
            (Cells{{0, 0}, {1, 0}, {0, 1}, {1, 1}, {2, 0}, {3, 0}}));
  for (const auto order : {CellOrder::random, CellOrder::adaptive}) {
    EXPECT_EQ(places(order, 1), places(order, 1));
    EXPECT_NE(places(order, 1), places(order, 2));
  }
}

TEST(IirraImportance, AdaptiveTakesTheGreatestContrastFirst) {
  const Ordering ordering{{0, 0, 64, 64}, 16, CellOrder::adaptive, 7, NOTHING};
  for (int x = 0; x < 64; x += 16) {
    const auto place = [&](double contrast) {
      return ordering.eval({x, 0, 16, 1}, {contrast, 0, 0}, {}).place;
    };
    EXPECT_LT(place(1), place(0.9));
    EXPECT_LT(place(0.9), place(0.1));
    EXPECT_LT(place(0.1), place(0));
    EXPECT_LT(ordering.eval({x, 0, 16, 1}, {0.5, 0, 0}, {}).place,
              ordering.eval({48 - x, 0, 16, 1}, {0.4, 0, 0}, {}).place);
  }
}

}  // namespace
}  // namespace iirra

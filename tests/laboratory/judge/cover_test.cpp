#include "experiments/laboratory/judge/cover.hpp"

#include <gtest/gtest.h>

#include <random>

namespace laboratory {
namespace {

// Student's prediction interval contains nine of ten further errors from the same distribution.
TEST(Cover, OwnErrorHasNineOfTenFurtherPoints) {
  constexpr int TRIALS = 20'000;
  for (const std::size_t count : {3, 5, 18}) {
    std::mt19937_64 random(count);
    std::normal_distribution<double> error(0.03, 0.02);
    int inside = 0;
    for (int i = 0; i < TRIALS; ++i) {
      std::vector<double> errors(count);
      for (double& e : errors) e = error(random);
      const auto own = find_own_error(errors).value();
      inside += std::abs(error(random) - own.mean) <= own.half_width;
    }
    EXPECT_NEAR(inside / double(TRIALS), 0.9, 0.01) << count;
  }
  EXPECT_FALSE(find_own_error({0.1, 0.2}));
}

// A result t over workers. On 90 % of the machines, t is between `low` and `high` times its nominal
// value.
struct Sure {
  explicit Sure(std::vector<double> expected, double low = 0.9, double high = 1.1) {
    Confidence confidence;
    confidence.machines = 19;
    CheckResult result;
    result.check.of = "t";
    result.verdict = Verdict::holds;
    for (std::size_t row = 0; row < expected.size(); ++row) {
      const double t = 100.0 / double(row + 1);
      table.rows.push_back({Value(std::int64_t(row + 1)), Value(t)});
      confidence.intervals.push_back({row, 1, t, low * t, t, high * t, {low * t, t, high * t}});
      result.points.push_back({.row = row, .simulated = t, .expected = expected[row] * t});
    }
    results = {result};
    check_cover(results, table, make_confidence_tables(table, confidence));
  }
  const CheckResult::Covered& covered() const { return results[0].covered.value(); }
  Table table{.columns = {"workers", "t"}, .axes = 1, .rows = {}};
  std::vector<CheckResult> results;
};

TEST(Cover, CountsWhatIsInItsInterval) {
  const Sure sure({0.95, 1.0, 1.05, 1.2, 0.8, 1.0});
  EXPECT_EQ(sure.covered().points, 6u);
  EXPECT_EQ(sure.covered().inside, 4u);
}

// All reference values are 20 % above the simulated values, and so outside every interval. The
// model's own error at a point is estimated from the errors at the other points.
TEST(Cover, OwnErrorMovesTheInterval) {
  const Sure sure({1.2, 1.2, 1.2, 1.2, 1.2, 1.2});
  EXPECT_EQ(sure.covered().inside, 0u);
  const auto own = sure.covered().with_own_error.value();
  EXPECT_EQ(own.inside, 6u);
  EXPECT_NEAR(own.half_width, 0.1, 1e-9);
  EXPECT_NEAR(own.mean, 0.2, 1e-9);
}

// Independent errors add like the sides of a right triangle: the squares of the half widths add.
TEST(Cover, OwnErrorIsAddedInSquares) {
  const std::vector<double> others = {0.95, 1.05, 0.95, 1.05, 0.95, 1.05};
  const auto own = find_own_error({0.05, -0.05, 0.05, -0.05, 0.05}).value();
  const Sure sure(others);
  EXPECT_NEAR(sure.covered().with_own_error.value().half_width, std::hypot(0.1, own.half_width),
              1e-9);
}

// All machines give larger results than the nominal model. The interval is only as wide as their
// spread.
TEST(Cover, MachinesBesideTheModelAreNoWiderThanTheyAre) {
  const Sure sure({1, 1, 1, 1}, 1.2, 1.4);
  EXPECT_EQ(sure.covered().inside, 0u);
  EXPECT_NEAR(sure.covered().with_own_error.value().half_width, 0.1, 1e-9);
}

// The model's own error at a point is estimated only from the other points. So the reference value
// that is twice the simulated value does not widen the interval at its own point, and stays
// outside.
TEST(Cover, APointTellsNothingOfItself) {
  const Sure sure({1.01, 0.99, 1.0, 2.0, 1.01, 0.99});
  EXPECT_EQ(sure.covered().inside, 5u);
  EXPECT_EQ(sure.covered().with_own_error.value().inside, 5u);
}

TEST(Cover, OwnErrorNeedsThreeOthers) {
  EXPECT_FALSE(Sure({1, 1, 1}).covered().with_own_error);
  EXPECT_TRUE(Sure({1, 1, 1, 1}).covered().with_own_error);
}

TEST(Cover, WhatIsCalibratedIsLeftOut) {
  Sure sure({1, 1, 1, 1});
  for (auto& point : sure.results[0].points) point.kind = Kind::calibrated;
  sure.results[0].covered.reset();
  sure.results[0].check.covers = 0.9;
  check_cover(sure.results, sure.table, {Table{}, Table{}});
  EXPECT_FALSE(sure.results[0].covered);
  EXPECT_EQ(sure.results[0].verdict, Verdict::fails);
}

}  // namespace
}  // namespace laboratory

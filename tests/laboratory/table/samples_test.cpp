// Seeds as samples: groups of rows, their means, and confidence intervals.
#include "experiments/laboratory/table/samples.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "experiments/laboratory/table/statistics.hpp"

namespace laboratory {
namespace {

Value whole(std::int64_t value) { return value; }

// A table with two loads and the given seeds, where t = load + seed.
Table make_seeded(const std::vector<int>& seeds) {
  Table table{.columns = {"load", "seed", "t"}, .axes = 2, .rows = {}};
  for (const int load : {10, 20})
    for (const int seed : seeds)
      table.rows.push_back({whole(load), whole(seed), load + seed * 1.0});
  return table;
}

TEST(ExperimentsSamples, RowsThatDifferOnlyInTheSeedAreAGroup) {
  const auto table = make_seeded({1, 2, 3});
  EXPECT_EQ(group_samples(table, all_rows(table)), (std::vector<RowList>{{0, 1, 2}, {3, 4, 5}}));
  EXPECT_EQ(group_samples(table, {1, 5, 2}), (std::vector<RowList>{{1, 2}, {5}}));
  EXPECT_EQ(number_samples(table), (std::vector<std::size_t>{0, 0, 0, 1, 1, 1}));
  EXPECT_EQ(name_seeds(table), "seed = 1, 2, 3");
}

TEST(ExperimentsSamples, OneSeedMakesNoGroups) {
  const auto table = make_seeded({7});
  EXPECT_TRUE(find_seeds(table).empty());
  EXPECT_EQ(group_samples(table, all_rows(table)), (std::vector<RowList>{{0}, {1}}));
  EXPECT_EQ(name_seeds(table), "");
}

TEST(ExperimentsSamples, OnlyAxesWithThatNameAreSeeds) {
  EXPECT_TRUE(is_seed("seed"));
  EXPECT_TRUE(is_seed("sample_seed"));
  EXPECT_FALSE(is_seed("seeds"));
  EXPECT_FALSE(is_seed("reseed"));
}

// Quantiles from a textbook's table of Student's distribution, for two-sided intervals of 95 %.
TEST(ExperimentsSamples, QuantilesAgreeWithPublishedTables) {
  for (const auto& [degrees, quantile] : std::vector<std::pair<int, double>>{
           {1, 12.706}, {2, 4.303}, {4, 2.776}, {9, 2.262}, {30, 2.042}, {120, 1.980}})
    EXPECT_NEAR(student_t(0.975, degrees), quantile, 5e-4) << degrees;
}

// The half width is t(n - 1) s / sqrt(n). For the samples 1, 2, 3 it is 4.303 * 1 / sqrt(3).
TEST(ExperimentsSamples, TheHalfWidthFollowsItsFormula) {
  const auto found = find_mean_interval({1, 2, 3});
  EXPECT_DOUBLE_EQ(found.mean, 2);
  EXPECT_NEAR(found.half_width.value(), 4.30265 / std::sqrt(3), 1e-4);
  EXPECT_TRUE(found.contains(2 + 2.4));
  EXPECT_FALSE(found.contains(2 + 2.5));
  EXPECT_FALSE(find_mean_interval({5}).half_width.has_value());
  EXPECT_EQ(find_mean_interval({0.1, 0.1, 0.1}).half_width, 0.0) << "no spread by rounding";
  EXPECT_THROW(find_mean_interval({}), std::invalid_argument);
}

// Samples are paired if both sides have the same seeds, in any order.
TEST(ExperimentsSamples, EqualSeedsArePairs) {
  const auto table = make_seeded({1, 2, 3});
  const RowSamples a{{0, 1, 2}, {11, 22, 33}}, b{{5, 4, 3}, {34, 23, 12}};
  const auto paired = compare_samples(table, a, b);
  EXPECT_DOUBLE_EQ(paired.mean, 1);
  EXPECT_EQ(paired.half_width, 0.0);
  const RowSamples two{{5, 4}, {34, 23}};
  EXPECT_GT(compare_samples(table, a, two).half_width.value(), 10) << "Welch's interval";
}

// The share of the intervals made by `draw` that contain the true value.
double find_share(const std::function<MeanInterval()>& draw, double truth) {
  constexpr int TRIALS = 20'000;
  int inside = 0;
  for (int i = 0; i < TRIALS; ++i) inside += draw().contains(truth);
  return double(inside) / TRIALS;
}

// Samples are normally distributed around a known mean. In the second case, the samples of a pair
// also share an effect of the seed, ten times as large. The share of intervals that contain the
// true mean has a standard error of 0.15 %.
TEST(ExperimentsSamples, NineteenOfTwentyIntervalsContainTheTrueMean) {
  for (const std::uint64_t seed : {1, 2})
    for (const std::size_t n : {2, 3, 5, 10}) {
      std::mt19937_64 random(seed);
      std::normal_distribution<double> noise;
      const auto draw = [&](double mean, double width) {
        std::vector<double> values(n);
        for (double& value : values) value = mean + width * noise(random);
        return values;
      };
      const auto what = "seed " + std::to_string(seed) + ", samples " + std::to_string(n);
      EXPECT_NEAR(find_share([&] { return find_mean_interval(draw(3, 2)); }, 3), 0.95, 0.015)
          << what;
      const auto pairs = [&] {
        const auto common = draw(0, 10);
        auto a = draw(3, 1), b = draw(5, 1);
        for (std::size_t i = 0; i < n; ++i) a[i] += common[i], b[i] += common[i];
        return find_paired_difference(a, b);
      };
      EXPECT_NEAR(find_share(pairs, 2), 0.95, 0.015) << what << ", in pairs";
      if (n < 5) continue;  // Welch's interval is only approximate for few samples
      EXPECT_NEAR(find_share([&] { return find_difference(draw(3, 1), draw(5, 3)); }, 2), 0.95,
                  0.015)
          << what << ", independent";
    }
}

}  // namespace
}  // namespace laboratory

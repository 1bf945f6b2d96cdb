#include "experiments/laboratory/compare/ratios.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/errors.hpp"

namespace laboratory {
namespace {

// t over workers 1 to `workers` and `seeds`, from number `first` on.
NamedTable make_run(const std::string& name, int workers, int seeds, int first,
                    const std::function<double(int worker, int seed)>& t) {
  NamedTable run{name, {.columns = {"workers", "farm_seed", "t"}, .axes = 2, .rows = {}}};
  for (int w = 1; w <= workers; ++w)
    for (int s = first; s < first + seeds; ++s)
      run.table.rows.push_back({Value(std::int64_t(w)), Value(std::int64_t(s)), Value(t(w, s))});
  return run;
}

// The share of trials whose interval holds the ratio of the distributions, 1.3.
double find_coverage(int first_seed_of_b, double common_noise) {
  constexpr int TRIALS = 3000;
  std::mt19937_64 random(7);
  std::normal_distribution<double> noise(0, 0.05);
  int inside = 0;
  for (int i = 0; i < TRIALS; ++i) {
    std::vector<double> common(30);
    for (double& x : common) x = common_noise * noise(random);
    const auto draw = [&](double mean) {
      return [&, mean](int, int seed) {
        return mean * std::exp(common.at(std::size_t(seed)) + noise(random));
      };
    };
    const std::vector<NamedTable> runs{make_run("a", 1, 5, 0, draw(1)),
                                       make_run("b", 1, 5, first_seed_of_b, draw(1.3))};
    const auto matched = match_points(runs);
    const auto ratio = find_ratio(runs, matched, matched.points.at(0), 1, "t").value();
    inside += ratio.interval->first <= 1.3 && 1.3 <= ratio.interval->second;
  }
  return inside / double(TRIALS);
}

TEST(Ratios, IntervalsHoldTheRatioNineteenTimesOfTwenty) {
  EXPECT_NEAR(find_coverage(0, 10), 0.95, 0.015) << "in pairs: what a seed does to both cancels";
  EXPECT_NEAR(find_coverage(10, 0), 0.95, 0.015) << "other seeds: Welch";
}

TEST(Ratios, WithoutSeedsAreThoseOfThePoints) {
  const std::vector<NamedTable> runs{make_run("a", 4, 1, 1, [](int w, int) { return 12.0 / w; }),
                                     make_run("b", 4, 1, 1, [](int w, int) { return 6.0 * w; })};
  const auto matched = match_points(runs);
  ASSERT_EQ(matched.points.size(), 4u);
  const auto table = compare_column(runs, matched, "t");
  EXPECT_EQ(table.columns, (std::vector<std::string>{"workers", "a: t", "b: t", "b / a"}));
  for (std::size_t i = 0; i < 4; ++i) {
    const auto w = double(i + 1);
    EXPECT_DOUBLE_EQ(*as_number(table.rows[i][3]), w * w / 2);
  }
  const auto spread = find_spread(runs, matched, 1, "t").value();
  EXPECT_DOUBLE_EQ(spread.least, 0.5);
  EXPECT_DOUBLE_EQ(spread.most, 8);
  EXPECT_DOUBLE_EQ(spread.mean, std::pow(24.0, 0.5) / 2);
  EXPECT_EQ(tell_spread(runs, matched, 1, "t", spread),
            "t: b is 2.449 of a (geometric mean of 4 points; 0.5 at workers = 1 to 8 at workers = "
            "4)");
}

TEST(Ratios, PointsOfOneRunAloneAreLeftOut) {
  const auto one = [](int, int) { return 1.0; };
  const std::vector<NamedTable> runs{make_run("a", 5, 2, 1, one), make_run("b", 3, 2, 1, one)};
  const auto matched = match_points(runs);
  EXPECT_EQ(matched.points.size(), 3u);
  EXPECT_EQ(matched.left_out, (std::vector<std::size_t>{4, 0}));
  EXPECT_TRUE(find_spread(runs, matched, 1, "t").value().is_same());
}

TEST(Ratios, NothingIsDividedByNothing) {
  for (const double nothing : {0.0, -1.0, double(NAN), double(INFINITY)}) {
    const std::vector<NamedTable> runs{make_run("a", 1, 1, 1, [&](int, int) { return nothing; }),
                                       make_run("b", 1, 1, 1, [](int, int) { return 1.0; })};
    const auto matched = match_points(runs);
    EXPECT_FALSE(find_ratio(runs, matched, matched.points[0], 1, "t")) << nothing;
  }
}

// An axis with one value in each run tells no points apart, whatever the values are.
TEST(Ratios, AnAxisWithOneValueIsNoPoint) {
  auto a = make_run("a", 2, 1, 1, [](int, int) { return 1.0; });
  auto b = a;
  for (auto* run : {&a, &b}) {
    run->table.columns.insert(run->table.columns.begin(), "topology");
    ++run->table.axes;
    for (auto& row : run->table.rows)
      row.insert(row.begin(), Value(std::string(run == &a ? "tree" : "mesh")));
  }
  const auto matched = match_points({a, b});
  EXPECT_EQ(matched.axes, std::vector<std::string>{"workers"});
  EXPECT_EQ(matched.points.size(), 2u);
}

TEST(Ratios, RunsOverOtherAxesAreRefused) {
  const auto one = [](int, int) { return 1.0; };
  auto a = make_run("a", 2, 1, 1, one), b = make_run("b", 2, 1, 1, one);
  b.table.columns[0] = "objects";
  EXPECT_THROW(match_points({a, b}), base::BadInput);
  auto far = make_run("far", 2, 1, 1, one);
  for (auto& row : far.table.rows) row[0] = Value(std::get<std::int64_t>(row[0]) + 10);
  try {
    match_points({a, far});
    FAIL();
  } catch (const base::BadInput& error) {
    EXPECT_STREQ(error.what(),
                 "found no point that all runs have (workers is 1, 2 in a; workers is 11, 12 in "
                 "far), expected some");
  }
}

}  // namespace
}  // namespace laboratory

#include "experiments/laboratory/compare/ratios.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/errors.hpp"

namespace laboratory {
namespace {

// Makes a run with a result t for each number of workers up to `workers`, and for each of `seeds`
// consecutive seeds, beginning with `first`.
NamedTable make_run(const std::string& name, int workers, int seeds, int first,
                    const std::function<double(int worker, int seed)>& t) {
  NamedTable run{name, {.columns = {"workers", "farm_seed", "t"}, .axes = 2, .rows = {}}};
  for (int w = 1; w <= workers; ++w)
    for (int s = first; s < first + seeds; ++s)
      run.table.rows.push_back({Value(std::int64_t(w)), Value(std::int64_t(s)), Value(t(w, s))});
  return run;
}

// The share of trials in which the interval contains the true ratio of the two distributions, 1.3.
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
    const auto matched = match_points(
        {make_run("a", 1, 5, 0, draw(1)), make_run("b", 1, 5, first_seed_of_b, draw(1.3))});
    const auto ratio = find_ratio(matched, matched.points.at(0), 1, "t").value();
    inside += ratio.interval->first <= 1.3 && 1.3 <= ratio.interval->second;
  }
  return inside / double(TRIALS);
}

TEST(Ratios, IntervalsHoldTheRatioNineteenTimesOfTwenty) {
  EXPECT_NEAR(find_coverage(0, 10), 0.95, 0.015) << "in pairs: what a seed does to both cancels";
  EXPECT_NEAR(find_coverage(10, 0), 0.95, 0.015) << "other seeds: Welch";
}

TEST(Ratios, WithoutSeedsAreThoseOfThePoints) {
  const auto matched = match_points({make_run("a", 4, 1, 1, [](int w, int) { return 12.0 / w; }),
                                     make_run("b", 4, 1, 1, [](int w, int) { return 6.0 * w; })});
  ASSERT_EQ(matched.points.size(), 4u);
  const auto table = compare_column(matched, "t");
  EXPECT_EQ(table.columns, (std::vector<std::string>{"workers", "a: t", "b: t", "b / a"}));
  for (std::size_t i = 0; i < 4; ++i) {
    const auto w = double(i + 1);
    EXPECT_DOUBLE_EQ(*as_number(table.rows[i][3]), w * w / 2);
  }
  const auto spread = find_spread(matched, 1, "t");
  EXPECT_DOUBLE_EQ(spread.least, 0.5);
  EXPECT_DOUBLE_EQ(spread.most, 8);
  EXPECT_DOUBLE_EQ(spread.mean, std::pow(24.0, 0.5) / 2);
  EXPECT_EQ(tell_spread(matched, 1, "t", spread),
            "t: b is 2.449 times a (geometric mean of 4 points; 0.5 at workers = 1 to 8 at workers "
            "= 4)");
}

TEST(Ratios, PointsOfOneRunAloneAreLeftOut) {
  const auto one = [](int, int) { return 1.0; };
  const auto matched = match_points({make_run("a", 5, 2, 1, one), make_run("b", 3, 2, 1, one)});
  EXPECT_EQ(matched.points.size(), 3u);
  EXPECT_EQ(matched.left_out, (std::vector<std::size_t>{4, 0}));
  EXPECT_TRUE(find_spread(matched, 1, "t").is_same());
}

// If the cell of a seed is empty in one run, the seed does not count in either run.
TEST(Ratios, EmptyCellsLeaveTheirSeedOut) {
  const auto run = [](const std::string& name, double factor, std::vector<int> empty) {
    auto made = make_run(name, 1, 5, 1, [&](int, int s) { return factor * std::exp(s) + s; });
    for (const int seed : empty) made.table.rows[std::size_t(seed - 1)][2] = Value();
    return made;
  };
  const auto expect = [&](const std::vector<int>& empty_a, const std::vector<int>& empty_b,
                          const std::vector<int>& left) {
    const auto matched = match_points({run("a", 1, empty_a), run("b", 2, empty_b)});
    const auto ratio = find_ratio(matched, matched.points.at(0), 1, "t");
    ASSERT_EQ(ratio.has_value(), !left.empty());
    EXPECT_FALSE(find_spread(matched, 1, "t").is_same());
    if (left.empty()) return;
    double logs = 0;
    for (const int s : left) logs += std::log((2 * std::exp(s) + s) / (std::exp(s) + s));
    EXPECT_NEAR(ratio->value, std::exp(logs / double(left.size())), 1e-12);
    EXPECT_EQ(ratio->interval.has_value(), left.size() > 1);
  };
  expect({2}, {2}, {1, 3, 4, 5});
  expect({1, 2}, {5}, {3, 4});
  expect({1, 2, 3}, {5}, {4});
  expect({1, 2, 3, 4, 5}, {1}, {});
}

// Results without a ratio are reported. They are never called equal.
TEST(Ratios, NothingIsDividedByNothing) {
  for (const double nothing : {0.0, -1.0, double(NAN), double(INFINITY)}) {
    const auto matched =
        match_points({make_run("a", 3, 1, 1, [&](int w, int) { return w == 2 ? nothing : 1.0; }),
                      make_run("b", 3, 1, 1, [](int, int) { return 1.0; })});
    EXPECT_FALSE(find_ratio(matched, matched.points[1], 1, "t")) << nothing;
    const auto spread = find_spread(matched, 1, "t");
    EXPECT_EQ(spread.points, 2u);
    EXPECT_EQ(spread.others, 1u);
    EXPECT_FALSE(spread.is_same()) << nothing;
    EXPECT_NE(tell_spread(matched, 1, "t", spread).find("without a ratio"), std::string::npos);
  }
  const auto zero = [](int, int) { return 0.0; };
  const auto matched = match_points({make_run("a", 3, 1, 1, zero), make_run("b", 3, 1, 1, zero)});
  EXPECT_TRUE(find_spread(matched, 1, "t").is_same());
}

// Each number is in the column of its heading, also if only some results have intervals.
TEST(Ratios, AreListedAsNumbers) {
  auto a = make_run("a", 1, 3, 1, [](int, int s) { return double(s); });
  auto b = make_run("b", 1, 3, 1, [](int, int s) { return 2.0 * s; });
  auto c = make_run("c", 1, 3, 1, [](int, int s) { return 3.0 * s; });
  for (auto* run : {&a, &b, &c}) {
    run->table.columns.push_back("zero");
    for (auto& row : run->table.rows) row.push_back(Value(0.0));
  }
  const auto table = list_ratios(match_points({a, b, c}), {"zero", "t"});
  EXPECT_EQ(table.columns,
            (std::vector<std::string>{"result", "run", "value", "first", "ratio", "low", "high"}));
  ASSERT_EQ(table.rows.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& row = table.rows[i];
    EXPECT_EQ(to_string(row[0]), i < 2 ? "zero" : "t");
    EXPECT_EQ(to_string(row[1]), i % 2 == 0 ? "b" : "c");
    if (i < 2) {
      for (std::size_t column = 4; column < 7; ++column) EXPECT_EQ(to_string(row[column]), "");
    } else {
      // the ratio is equal for all pairs of samples, so the interval has no width
      const double ratio = i == 2 ? 2 : 3;
      EXPECT_NEAR(*as_number(row[2]), ratio * std::cbrt(6), 1e-12);
      EXPECT_NEAR(*as_number(row[3]), std::cbrt(6), 1e-12);
      for (std::size_t column = 4; column < 7; ++column)
        EXPECT_NEAR(*as_number(row[column]), ratio, 1e-9);
    }
  }
}

// The comparison of two runs does not depend on a third run.
TEST(Ratios, AreThoseOfTwoRuns) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise(0, 0.1);
  const auto draw = [&](int, int) { return std::exp(noise(random)); };
  const auto a = make_run("a", 2, 4, 1, draw), b = make_run("b", 2, 4, 1, draw);
  const auto c = make_run("c", 2, 3, 10, draw);
  const auto two = match_points({a, b}), three = match_points({a, b, c});
  for (std::size_t i = 0; i < 2; ++i) {
    const auto alone = find_ratio(two, two.points[i], 1, "t").value();
    const auto beside = find_ratio(three, three.points[i], 1, "t").value();
    EXPECT_EQ(alone.value, beside.value);
    EXPECT_EQ(alone.interval, beside.interval);
  }
}

// An axis that has one value in each run does not distinguish points, even if the runs have
// different values.
TEST(Matching, AnAxisWithOneValueIsNoPoint) {
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

std::string refusal_of(const std::vector<NamedTable>& runs) {
  try {
    match_points(runs);
  } catch (const base::BadInput& error) {
    return error.what();
  }
  return "";
}

TEST(Matching, RunsOverOtherAxesAreRefused) {
  const auto one = [](int, int) { return 1.0; };
  auto a = make_run("a", 2, 1, 1, one), b = make_run("b", 2, 1, 1, one);
  b.table.columns[0] = "objects";
  EXPECT_EQ(refusal_of({a, b}),
            "found the axis workers with several values in a but not in b, expected the same axes "
            "in all runs");
  auto far = make_run("far", 2, 1, 1, one);
  for (auto& row : far.table.rows) row[0] = Value(std::get<std::int64_t>(row[0]) + 10);
  EXPECT_EQ(refusal_of({a, far}),
            "found no point that all runs have (workers is 1, 2 in a; workers is 11, 12 in far), "
            "expected at least one");
}

// If two seeds are combined in all ways, samples share seeds and are not independent, so the runs
// are refused. Two seeds that change together are accepted like one.
TEST(Matching, OneSeedTellsSamplesApart) {
  auto run = make_run("a", 1, 2, 1, [](int, int) { return 1.0; });
  run.table.columns.insert(run.table.columns.begin(), "seed");
  ++run.table.axes;
  const auto rows = run.table.rows;
  run.table.rows.clear();
  for (int seed : {1, 2})
    for (auto row : rows) {
      row.insert(row.begin(), Value(std::int64_t(seed)));
      run.table.rows.push_back(row);
    }
  EXPECT_EQ(refusal_of({run, run}),
            "found two seeds with several values, seed and farm_seed, in a, expected one: its "
            "values are the samples");
  std::erase_if(run.table.rows, [](const auto& row) { return row[0] != row[2]; });
  EXPECT_EQ(match_points({run, run}).points.at(0).rows[0].size(), 2u);
}

}  // namespace
}  // namespace laboratory

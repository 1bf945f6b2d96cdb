// Intervals of results and influences of entries, for functions with known answers.
#include "experiments/laboratory/uncertain/intervals.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "base/random.hpp"
#include "experiments/laboratory/uncertain/draw.hpp"

namespace laboratory {
namespace {

struct Sample {
  std::vector<std::string> entries;
  std::vector<std::vector<double>> quantiles;
  std::vector<double> results;
};

using Function = std::function<double(const std::vector<double>&)>;

Sample sample(std::size_t inputs, std::size_t machines, std::uint64_t seed,
              const Function& function) {
  Sample s;
  for (std::size_t i = 0; i < inputs; ++i) {
    s.entries.push_back("x" + std::to_string(i + 1));
    s.quantiles.emplace_back();
    for (std::size_t m = 0; m < machines; ++m)
      s.quantiles[i].push_back(draw_quantiles(seed, s.entries[i], machines)[m]);
  }
  for (std::size_t m = 0; m < machines; ++m) {
    std::vector<double> x;
    for (const auto& all : s.quantiles) x.push_back(all[m]);
    s.results.push_back(function(x));
  }
  return s;
}

const Influence& find(const std::vector<Influence>& all, const std::string& entry) {
  return *std::ranges::find(all, entry, &Influence::entry);
}

// A table has a single cell, and `results` are the values of this cell on the drawn machines.
// Returns the interval of the cell.
Interval interval_of(const std::vector<double>& results) {
  const auto table = [](double y) { return Table{{"y"}, 0, {{Value(y)}}, {}}; };
  std::vector<Table> machines;
  for (const double y : results) machines.push_back(table(y));
  return find_intervals(table(0), machines).at(0);
}

bool has(const std::vector<Influence>& all, const std::string& entry) {
  return std::ranges::find(all, entry, &Influence::entry) != all.end();
}

// y = 3 x1 + x2 exactly. Swings are 0.9 times the factors, and the third entry has no influence.
TEST(Influences, OfASumAreItsFactors) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const auto s = sample(3, 64, seed, [](const auto& x) { return 3 * x[0] + x[1]; });
    const auto all = find_influences(s.results, s.entries, s.quantiles);
    ASSERT_EQ(all.size(), 2u) << "seed " << seed;
    EXPECT_EQ(all[0].entry, "x1");
    EXPECT_NEAR(all[0].swing, 2.7, 1e-9) << "seed " << seed;
    EXPECT_NEAR(all[1].swing, 0.9, 1e-9) << "seed " << seed;
    EXPECT_NEAR(all[0].correlation, 3 / std::sqrt(10), 0.06) << "seed " << seed;
  }
}

// The result is a sum of two entries and noise. The other 100 entries have no effect. The factors
// of the sum are found within their standard errors. Entries without effect are seldom selected.
TEST(Influences, AreFoundAmongMany) {
  int others = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    base::Random noise(seed);
    const auto s = sample(102, 64, seed, [&](const auto& x) {
      return 3 * x[0] - 2 * x[1] + 0.3 * (noise.uniform() - 0.5);
    });
    const auto all = find_influences(s.results, s.entries, s.quantiles);
    for (const auto& [entry, swing] : {std::pair("x1", 2.7), {"x2", -1.8}}) {
      ASSERT_TRUE(has(all, entry)) << "seed " << seed;
      EXPECT_NEAR(find(all, entry).swing, swing, 4 * find(all, entry).error) << "seed " << seed;
      EXPECT_LT(find(all, entry).error, 0.1) << "seed " << seed;
    }
    others += static_cast<int>(all.size()) - 2;
  }
  EXPECT_LE(others, 4);
}

// The function y = exp(2 x1) exp(x2) grows from 1 to 20. The influence of an entry follows from the
// slope of the best straight line through y as a function of the entry.
TEST(Influences, OfAProductNameItsFactors) {
  const auto s =
      sample(4, 256, 3, [](const auto& x) { return std::exp(2 * x[0]) * std::exp(x[1]); });
  const auto all = find_influences(s.results, s.entries, s.quantiles);
  ASSERT_GE(all.size(), 2u);
  EXPECT_EQ(all[0].entry, "x1");
  EXPECT_EQ(all[1].entry, "x2");
  // The best line through exp(2 u) over u has the slope 12 Cov(u, exp(2 u)) = 6. It is multiplied
  // by the mean of exp(x2).
  EXPECT_NEAR(all[0].swing, 0.9 * 6 * (std::exp(1) - 1), 4 * all[0].error);
}

// The function of Ishigami and Homma (1990) with a = 7 and b = 0.1. Regression over x1 gives the
// slope E[x y] / E[x x], where E[x sin x] = 1. Over x2 and x3, the slope is zero.
TEST(Influences, OfIshigamisFunction) {
  constexpr double PI = std::numbers::pi, A = 7, B = 0.1;
  const auto s = sample(3, 4096, 11, [](const auto& q) {
    const auto x = [&](std::size_t i) { return PI * (2 * q[i] - 1); };
    return std::sin(x(0)) + A * std::pow(std::sin(x(1)), 2) +
           B * std::pow(x(2), 4) * std::sin(x(0));
  });
  const auto all = find_influences(s.results, s.entries, s.quantiles);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].entry, "x1");
  // the expected slope per unit of the quantile
  const double slope = (1 + B * std::pow(PI, 4) / 5) / (PI * PI / 3) * 2 * PI;
  EXPECT_NEAR(all[0].swing, 0.9 * slope, 4 * all[0].error);
  EXPECT_LT(all[0].error, 0.03 * slope);
}

// For a uniformly distributed result, the interval is that of the uniform distribution, which
// contains 90 % of new results.
TEST(Intervals, CoverWhatTheyClaim) {
  const auto y = [](const auto& x) { return x[0] + x[1]; };
  int inside = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto interval = interval_of(sample(2, 64, seed, y).results);
    base::Random random(seed);
    for (int i = 0; i < 500; ++i, ++all) {
      const double fresh = random.uniform() + random.uniform();
      inside += interval.low <= fresh && fresh <= interval.high;
    }
  }
  EXPECT_NEAR(inside / double(all), 0.9, 0.03);
  const auto uniform = interval_of(sample(1, 200, 4, [](const auto& x) { return x[0]; }).results);
  EXPECT_NEAR(uniform.low, 0.05, 0.01);
  EXPECT_NEAR(uniform.median, 0.5, 0.01);
  EXPECT_NEAR(uniform.high, 0.95, 0.01);
}

TEST(Intervals, RowsAreMatchedByTheirAxesAndWhatIsTheSameEverywhereIsLeftOut) {
  const Table table{{"n", "y", "z", "name"},
                    1,
                    {{Value(std::int64_t{1}), Value(10.), Value(5.), Value("a")},
                     {Value(std::int64_t{2}), Value(20.), Value(5.), Value("b")}},
                    {}};
  std::vector<Table> machines(3, table);
  for (std::size_t i = 0; i < 3; ++i) {
    machines[i].rows[0][1] = 10. + double(i);
    machines[i].rows[1][1] = 20. + double(i);
  }
  std::swap(machines[1].rows[0], machines[1].rows[1]);
  const auto intervals = find_intervals(table, machines);
  ASSERT_EQ(intervals.size(), 2u);
  EXPECT_EQ(intervals[0].machines, (std::vector{10., 11., 12.}));
  EXPECT_EQ(intervals[1].machines, (std::vector{20., 21., 22.}));
  const auto lines = to_csv(make_intervals_table(table, intervals));
  EXPECT_EQ(lines.substr(0, lines.find('\n')), "n,column,value,p5,p50,p95");
  machines[2].rows.pop_back();  // the cell has no interval, because one machine lacks its row
  EXPECT_EQ(find_intervals(table, machines).size(), 1u);
}

}  // namespace
}  // namespace laboratory

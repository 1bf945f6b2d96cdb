// Sentences and drawings about the uncertainty of results.
#include "experiments/laboratory/uncertain/confidence.hpp"

#include <gtest/gtest.h>

#include "experiments/laboratory/table/table.hpp"
#include "experiments/laboratory/uncertain/tornado.hpp"

namespace laboratory {
namespace {

// The data of the bars in a script, one line each.
std::vector<std::string> bars(const std::string& script) {
  const auto from = script.find("<< END\n") + 7, to = script.find("END\nset border");
  std::vector<std::string> lines;
  for (std::size_t at = from, end; at < to; at = end + 1)
    lines.push_back(script.substr(at, (end = script.find('\n', at)) - at));
  return lines;
}

TEST(Confidence, TellsTheStrongestFirstAndAllThatFollow) {
  const ConfidenceTables tables{
      parse_csv("workers,column,value,p5,p95\n2,s,10,9,11\n4,s,20,18,22\n", "intervals.csv"),
      parse_csv("workers,column,entry,swing\n2,s,a,0.2\n2,s,b,2\n2,s,c,0.4\n"
                "4,s,a,0.4\n4,s,b,4\n4,s,c,0.8\n",
                "assumptions.csv")};
  EXPECT_EQ(describe_confidence(tables, {"s", "other"}),
            std::vector<std::string>{
                "s: ± 10 % on nine of ten machines (the median of 2 rows); of the assumptions, b "
                "matters most: ± 10 % (the median of 2 rows); then c ± 2 %, a ± 1 %"});
}

// On each machine the result is 10 (1 + q), where q is the quantile of the entry "a". So it changes
// by 9 between the quantiles 5 % and 95 %.
TEST(Confidence, AssumptionsNameTheEntryThatChangesTheResult) {
  constexpr int MACHINES = 24;
  const Table table{
      .columns = {"workers", "s"}, .axes = 1, .rows = {{std::int64_t{2}, 15.0}}, .points = {}};
  Confidence confidence;
  confidence.entries = {"a", "b"};
  confidence.quantiles.resize(2);
  std::vector<double> results;
  for (int i = 0; i < MACHINES; ++i) {
    confidence.quantiles[0].push_back((i + 0.5) / MACHINES);
    confidence.quantiles[1].push_back((7 * i % MACHINES + 0.5) / MACHINES);
    results.push_back(10 * (1 + confidence.quantiles[0].back()));
  }
  confidence.intervals = {{0, 1, 15, 10.5, 15, 19.5, results}};
  const auto assumptions = make_confidence_tables(table, confidence).assumptions;
  ASSERT_FALSE(assumptions.rows.empty());
  const auto& strongest = assumptions.rows[0];
  EXPECT_EQ(strongest[0], Value(std::int64_t{2}));
  EXPECT_EQ(strongest[1], Value("s"));
  EXPECT_EQ(strongest[2], Value("a"));
  EXPECT_NEAR(*as_number(strongest[3]), 9, 1e-9);
}

TEST(Tornado, ShowsTheTwelveStrongest) {
  std::vector<Weight> weights;
  for (int i = 0; i < 15; ++i) weights.push_back({"e" + std::to_string(i), 0.01 * (i + 1), 1});
  const base::FigureStyle paper{.width_mm = 85};
  EXPECT_EQ(make_tornado_script("s", weights, paper).find("set title"), std::string::npos);
  // a legend of two lines, axis, 12 bars, gap: 8 (3.2 + 5 + 12 * 1.75 + 0.6) points
  EXPECT_EQ(tornado_height(weights, paper), 239);
  const auto script = make_tornado_script("s", weights);
  const auto shown = bars(script);
  ASSERT_EQ(shown.size(), 12u) << script;
  EXPECT_EQ(shown.front(), "12 15");
  EXPECT_EQ(shown.back(), "1 4");
  EXPECT_EQ(script.find("\"e2\""), std::string::npos);
  EXPECT_NE(script.find("\"e3\" 1)"), std::string::npos);
  // a step of the ticks that is round, and at most the largest influence of 15 %
  EXPECT_NE(script.find("set xtics 10\n"), std::string::npos) << script;
  EXPECT_EQ(tornado_height(weights), tornado_height({weights.begin(), weights.begin() + 12}));
  EXPECT_GT(tornado_height(weights), tornado_height({weights.begin(), weights.begin() + 11}));
}

}  // namespace
}  // namespace laboratory

// Plots of histograms.
#include "experiments/laboratory/report/histogram_plot.hpp"

#include <fstream>

#include "base/errors.hpp"
#include "experiments/laboratory/judge/check_plan.hpp"
#include "experiments/laboratory/plot/plot_script.hpp"
#include "tests/laboratory/support/tlab.hpp"

namespace laboratory {
namespace {

using Numbers = std::vector<double>;

// Two points of the pattern "a", whose seeds differ, and one of the pattern "b".
const Table RESULTS{.columns = {"pattern", "seed", "time_s"},
                    .axes = 2,
                    .rows = {{"a", 1, 0.1}, {"a", 2, 0.1}, {"b", 1, 0.1}}};

std::vector<Value> make_bin(double low, double high, int count) {
  return {"", Value(), "latency_s", "messages", low, high, count, Value()};
}

const Table HISTOGRAMS{
    .columns = {"pattern", "seed", "quantity", "of", "low", "high", "count", "share"},
    .axes = 2,
    .rows = {make_bin(0.5, 1, 3),
             make_bin(1, 2, 1),
             make_bin(1, 2, 2),
             make_bin(4, 8, 2),
             make_bin(0.5, 1, 7),
             {"", Value(), "link_load", "links", 0.0, 0.5, 9, Value()}},
    .points = {0, 0, 1, 1, 2, 2}};

TEST(ExperimentsHistograms, PointsThatDifferInTheSeedAreAdded) {
  const auto plot = plot_histogram(HISTOGRAMS, "latency_s", RESULTS, {0, 1, 2}, {0});
  ASSERT_EQ(plot.series.size(), 2u);
  // 8 messages: 3 in the first bin, 1 + 2 in the second, none between 2 and 4, 2 in the last
  EXPECT_EQ(plot.series[0].x, (Numbers{0.5, 0.5, 1, 2, 4, 8}));
  EXPECT_EQ(plot.series[0].y, (Numbers{0, 0.375, 0.375, 0, 0.25, 0}));
  EXPECT_EQ(plot.series[1].y, (Numbers{0, 1, 0}));
  EXPECT_EQ(plot.series[0].short_name(), "a");
  EXPECT_EQ(plot.legend_title, "pattern");
  EXPECT_EQ(plot.x_label, "latency [s]");
  EXPECT_EQ(plot.y_label, "share of messages");
  EXPECT_TRUE(plot.log_x);
  const auto loads = plot_histogram(HISTOGRAMS, "link_load", RESULTS, {0, 1, 2}, {0});
  ASSERT_EQ(loads.series.size(), 1u) << "only one point has this quantity";
  EXPECT_FALSE(loads.log_x) << "the first bin begins at 0";
}

TEST(ExperimentsHistograms, StepsHaveNoSymbolsAndTheirOwnTicks) {
  auto plot = plot_histogram(HISTOGRAMS, "latency_s", RESULTS, {0, 1, 2}, {0});
  plot.name = "p";
  auto script = make_gnuplot_script(plot);
  EXPECT_TRUE(contains(script, "$data1 with steps linecolor rgb '#D55E00' linewidth 2 dashtype"));
  EXPECT_FALSE(contains(script, "pointtype")) << script;
  EXPECT_TRUE(contains(script, "set xtics ('0.5' 0.5, '1' 1, '2' 2, '5' 5)")) << script;
  EXPECT_FALSE(contains(script, "set logscale x 2"));
}

const std::string EXPERIMENT =
    "[program]\nname = \"traffic\"\nwindow_s = 0.02\n[network]\ntopology = \"ring:4\"\n"
    "[sweep]\nload = [0.1, 0.2]\n[[plot]]\nname = \"h\"\nkind = \"histogram\"\n";

std::string message_for(const std::string& rest) {
  const TemporaryFolder folder;
  std::ofstream(folder.path / "e.toml") << EXPERIMENT + rest;
  return message_of<base::BadInput>(
      [&] { plan_checks(load_experiment((folder.path / "e.toml").string(), {})); });
}

TEST(ExperimentsHistograms, OnlyQuantitiesOfTheProgramAndNoCurves) {
  EXPECT_TRUE(contains(message_for("x = \"latency\"\n"), "found latency, expected a quantity"));
  EXPECT_TRUE(contains(message_for("x = \"latency\"\n"), "latency_s"));
  EXPECT_TRUE(contains(message_for("x = \"latency_s\"\ny = \"packets\"\nideal = true\n"),
                       "found y and ideal, expected none with kind = \"histogram\""))
      << message_for("x = \"latency_s\"\ny = \"packets\"\nideal = true\n");
}

TEST(ExperimentsHistograms, ARunWritesThemAll) {
  if (!is_gnuplot_installed()) GTEST_SKIP() << "gnuplot is not installed";
  const TemporaryFolder folder;
  std::ofstream(folder.path / "e.toml") << EXPERIMENT + "x = \"latency_s\"\n";
  for (int i = 0; i < 2; ++i) {  // the second time from the records
    const auto run = tlab(folder.path, {"run", "e.toml", "-o", "out"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const auto text = read_file(folder.path / "out/histogram.csv");
    const auto table = parse_csv(text, "histogram.csv"),
               results = parse_csv(read_file(folder.path / "out/results.csv"), "results.csv");
    double messages = 0, links = 0;
    for (const auto& row : table.rows) {
      if (*as_number(row[*table.find("load")]) != 0.1) continue;
      const auto count = *as_number(row[*table.find("count")]);
      (row[*table.find("quantity")] == Value("latency_s") ? messages : links) += count;
    }
    EXPECT_EQ(links, 8) << "a ring of four processors has four links with two directions";
    EXPECT_GT(messages, 0);
    EXPECT_LE(messages, *as_number(results.rows[0][*results.find("packets")]));
    EXPECT_TRUE(contains(read_file(folder.path / "out/plots/h.svg"), "share of messages"));
  }
}

}  // namespace
}  // namespace laboratory

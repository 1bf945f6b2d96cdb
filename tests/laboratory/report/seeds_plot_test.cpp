// Plots of results for several seeds: curves of means with error bars.
#include <cmath>

#include "experiments/laboratory/plot/plot.hpp"
#include "experiments/laboratory/plot/plot_data.hpp"
#include "experiments/laboratory/plot/plot_script.hpp"
#include "experiments/laboratory/report/findings.hpp"
#include "tests/laboratory/support/support.hpp"

namespace laboratory {
namespace {

// Two networks, three loads and five seeds, in the order of a sweep. t = load + 0.1 (seed - 3), and
// 1 more for the mesh.
Table make_seed_sweep() {
  Table table{.columns = {"topology", "load", "seed", "t"}, .axes = 3, .rows = {}};
  for (const std::int64_t mesh : {0, 1})
    for (const double load : {1.0, 2.0, 4.0})
      for (std::int64_t seed = 1; seed <= 5; ++seed)
        table.rows.push_back(
            {mesh ? "mesh" : "line", load, seed, load + double(mesh) + 0.1 * double(seed - 3)});
  return table;
}

TEST(ExperimentsSeedPlots, HaveOnePointForAllSeeds) {
  const auto plots = make_plots(make_seed_sweep(), {"t"});
  ASSERT_EQ(plots.size(), 1u);
  ASSERT_EQ(plots[0].series.size(), 2u) << "no curve for each seed";
  const Series& line = plots[0].series[0];
  EXPECT_EQ(line.name, "line");
  EXPECT_EQ(line.x, (std::vector<double>{1, 2, 4}));
  EXPECT_NEAR(line.y[1], 2, 1e-12);
  EXPECT_EQ(line.rows, (RowList{0, 5, 10}));
  ASSERT_TRUE(line.has_bars);
  // standard deviation s = 0.1581, and Student's t = 2.776 for 4 degrees of freedom
  EXPECT_NEAR(line.high[1] - line.low[1], 2 * 2.77645 * 0.15811 / std::sqrt(5), 1e-4);
}

TEST(ExperimentsSeedPlots, AnotherAxisThanTheSeedIsX) {
  Table table{.columns = {"seed", "t"}, .axes = 1, .rows = {}};
  for (std::int64_t seed = 1; seed <= 5; ++seed) table.rows.push_back({seed, 1.0});
  EXPECT_TRUE(make_plots(table, {"t"}).empty());
}

TEST(ExperimentsSeedPlots, DrawErrorBarsAndNoBand) {
  const auto table = make_seed_sweep();
  const auto plot = make_plots(table, {"t"}).at(0);
  const auto script = make_gnuplot_script(plot);
  EXPECT_TRUE(contains(script, "with yerrorbars"));
  EXPECT_FALSE(contains(script, "filledcurves"));
  EXPECT_TRUE(contains(make_plot_data(plot, table), "\"bars\":true"));
}

TEST(ExperimentsSeedPlots, ABarThatReachesZeroOnALogarithmicScaleEndsAtItsPoint) {
  Plot plot;
  plot.log_y = true;
  plot.series = {{.name = "s",
                  .x = {1, 2, 3},
                  .y = {4, 5, 6},
                  .low = {-1, 3, 0},
                  .high = {9, 7, 12},
                  .has_bars = true}};
  const auto script = make_gnuplot_script(plot);
  EXPECT_TRUE(contains(script, "$bars0 << END\n1 4 4 9\n2 5 3 7\n3 6 6 12\nEND\n")) << script;
}

// For each seed, the difference between the networks is exactly 1.
TEST(ExperimentsSeedPlots, FindingsQuoteIntervals) {
  const auto table = make_seed_sweep();
  const auto plots = make_plots(table, {"t"});
  const auto findings = tell_plots(plots, false, table, std::vector<PointLoads>(30));
  ASSERT_FALSE(findings.empty());
  EXPECT_TRUE(contains(findings.back(), "mesh (5 ± 0.2) and smallest for line (4 ± 0.2)"))
      << findings.back();
  EXPECT_TRUE(contains(findings.back(), "the difference is 1 ± ")) << findings.back();
}

// The picture of the second seed grows in the same way as that of the first, but takes 1.5 times as
// long. The values of the first are interpolated at the times of the second.
TEST(ExperimentsSeedPlots, GrowthIsAveragedInTime) {
  Table growth{.columns = {"seed", "growth_s", "ssim", "border_energy"},
               .axes = 1,
               .rows = {},
               .points = {}};
  for (const std::int64_t seed : {1, 2})
    for (const double share : {0.0, 0.5, 1.0}) {
      growth.rows.push_back({seed, share * (1 + double(seed)) / 2, share, 1.0});
      growth.points.push_back(std::size_t(seed - 1));
    }
  const auto plots = plot_growth(growth);
  ASSERT_EQ(plots.size(), 2u);
  EXPECT_NE(plots[0].title, plots[1].title);
  ASSERT_EQ(plots[0].series.size(), 1u) << "no curve for each seed";
  EXPECT_EQ(plots[0].series[0].x, (std::vector<double>{0, 0.75, 1.5}));
  EXPECT_EQ(plots[0].series[0].y, (std::vector<double>{0, (0.75 + 0.5) / 2, 1}))
      << "at 0.75 s the first is three quarters done and the second is half done";
  EXPECT_TRUE(plots[0].series[0].has_bars);
}

}  // namespace
}  // namespace laboratory

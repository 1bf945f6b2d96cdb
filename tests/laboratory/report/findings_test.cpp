// Sentences of the report about its plots and points.
#include "experiments/laboratory/report/findings.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "experiments/laboratory/table/laws.hpp"

namespace laboratory {
namespace {

using Texts = std::vector<std::string>;

// Speed-ups for two problem sizes. From 4 workers on, the speed-up of the smaller problem grows
// with the square root of the number of workers; from 8 workers on, coordination limits it. The
// speed-up of the larger problem is ideal.
struct Sweep {
  Table table{.columns = {"workers", "objects", "speedup"}, .axes = 2, .rows = {}};
  std::vector<PointLoads> points;
  Plot plot;

  Sweep() {
    plot.name = "speedup";
    plot.title = "Speed-up: tree";
    plot.x_label = "workers";
    plot.y_label = "speed-up";
    for (const int objects : {200, 3200})
      for (const int n : {1, 2, 4, 8, 16, 32}) {
        const bool is_limited = objects == 200 && n >= 8;
        const double y = objects == 200 ? n / std::sqrt(std::max(1.0, n / 4.0)) : n;
        add_point(plot.series, std::to_string(objects) + " objects", table.rows.size(), n, y);
        table.rows.push_back({n, objects, y});
        points.push_back({"", "done", {{"workers", 0.95, "tasks 95 %"}}});
        if (is_limited)
          points.back().loads.insert(points.back().loads.begin(),
                                     {"coordination", 0.98, "its CPU 42 %, for replies 52 %"});
      }
  }
};

TEST(ExperimentsFindings, WhereItBendsWhatLimitsItWhichIsLargest) {
  Sweep sweep;
  EXPECT_EQ(tell_plots({sweep.plot}, false, sweep.table, sweep.points),
            (Texts{"Speed-up bends at 4 workers for 200 objects (workers^1.00, then workers^0.50); "
                   "it has no bend for 3200 objects (goes as workers^1.00).",
                   "Limited by coordination from 8 workers on for 200 objects (at 32 workers 0.98: "
                   "its CPU 42 %, for replies 52 %); by workers throughout for 3200 objects (at 32 "
                   "workers 0.95: tasks 95 %).",
                   "At 32 workers speed-up is largest for 3200 objects (32) and smallest for 200 "
                   "objects (11.3)."}));
}

TEST(ExperimentsFindings, TheLimitsOfOnePointAreToldOnce) {
  Sweep sweep;
  auto again = sweep.plot, untitled = sweep.plot;
  again.title = "Again";
  untitled.title = "Speed-up";
  const auto findings = tell_plots({sweep.plot, again, untitled}, true, sweep.table, sweep.points);
  ASSERT_EQ(findings.size(), 3u);
  EXPECT_TRUE(findings[0].starts_with("Speed-up: tree: Speed-up bends at 4 workers"));
  EXPECT_NE(findings[0].find(". Limited by coordination from 8"), std::string::npos);
  EXPECT_TRUE(findings[1].starts_with("Again: Speed-up bends at 4 workers"));
  EXPECT_EQ(findings[1].find("Limited"), std::string::npos);
  EXPECT_TRUE(findings[2].starts_with("Speed-up bends at 4 workers"));
  EXPECT_NE(findings[1].find(". At 32 workers"), std::string::npos);
}

TEST(ExperimentsFindings, OneCurveNeedsNoName) {
  Sweep sweep;
  sweep.plot.series.resize(1);
  sweep.plot.series[0].name = "";
  EXPECT_EQ(tell_plots({sweep.plot}, false, sweep.table, sweep.points),
            (Texts{"Speed-up bends at 4 workers (workers^1.00, then workers^0.50).",
                   "Limited by coordination from 8 workers on (at 32 workers 0.98: its CPU 42 %, "
                   "for replies 52 %)."}));
}

TEST(ExperimentsFindings, CurvesThatAreAlikeAreToldTogether) {
  Sweep sweep;
  auto& series = sweep.plot.series;
  series[0] = series[1];
  series.push_back(series[1]);
  for (auto& point : sweep.points) point.loads = {{"link a>b", 0.5, ""}};
  sweep.plot.x_label = "distance [m]";
  EXPECT_EQ(tell_plots({sweep.plot}, false, sweep.table, sweep.points),
            (Texts{"Speed-up has no bend for all 3 curves (goes as distance^1.00).",
                   "Nothing is saturated at the end for all 3 curves (3200 objects at 32 m, "
                   "busiest link a>b 0.50).",
                   "At 32 m the 3 curves have the same speed-up within 1 %: 32."}));
}

TEST(ExperimentsFindings, NothingIsSaidOfWhatIsNotKnown) {
  Sweep sweep;
  for (auto& s : sweep.plot.series) s.x.resize(2), s.y.resize(2), s.rows.resize(2);
  for (auto& x : sweep.plot.series[1].x) x += 0.5;  // the curves have no x in common
  for (auto& point : sweep.points) point.loads.clear();
  EXPECT_EQ(tell_plots({sweep.plot}, false, sweep.table, sweep.points), Texts{});
  EXPECT_EQ(tell_plots({}, true, sweep.table, sweep.points), Texts{});
}

TEST(ExperimentsFindings, WithoutPlotsThePointsAreCounted) {
  const PointLoads workers{"", "done", {{"workers", 0.9, "tasks 90 %"}}},
      idle{"", "done", {{"a", 0.1, ""}}}, link{"", "done", {{"link a>b", 0.8, ""}}},
      other{"", "done", {{"link b>c", 0.85, ""}}};
  EXPECT_EQ(tell_points({}), Texts{});
  EXPECT_EQ(tell_points({PointLoads()}), Texts{});
  EXPECT_EQ(tell_points({workers, {}}), Texts{"Limited by workers 0.90: tasks 90 %."});
  EXPECT_EQ(tell_points({idle, idle}), Texts{"Nothing is saturated in any of 2 points."});
  EXPECT_EQ(tell_points({workers, idle, link, other}),
            Texts{"Limited: 2 of 4 points by a link, 1 by workers; in 1 nothing is saturated."});
}

TEST(ExperimentsFindings, APointSaysWhyItIsNotFaster) {
  PointLoads point{"", "done", {{"coordination", 0.984, "its CPU 42 %, waiting for replies 52 %"}}};
  EXPECT_EQ(explain(point),
            "Limited by coordination 0.98: its CPU 42 %, waiting for replies 52 %.");
  point.loads[0].busy = 0.79;
  EXPECT_EQ(find_limit(point), nullptr);
  EXPECT_EQ(explain(point),
            "Nothing is saturated; the busiest is coordination 0.79: its CPU 42 %, waiting for "
            "replies 52 %.");
  EXPECT_EQ(explain({}), "");
}

}  // namespace
}  // namespace laboratory

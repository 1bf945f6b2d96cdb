// Speed-ups of programs that say they have some.
#include "experiments/laboratory/points/results.hpp"

#include <gtest/gtest.h>

namespace laboratory {
namespace {

using I = std::int64_t;

Table make(std::vector<std::vector<Value>> rows) {
  return {.columns = {"topology", "processors", "time_s", "speedup", "efficiency", "ended"},
          .axes = 2,
          .rows = std::move(rows)};
}

TEST(ExperimentsSpeedups, AreAgainstOneProcessorAndOtherwiseTheSame) {
  auto table = make({{"mesh", I{4}, 2.5, {}, {}, "done"},
                     {"mesh", I{1}, 8.0, {}, {}, "done"},
                     {"line", I{1}, 9.0, {}, {}, "done"},
                     {"line", I{4}, 3.0, {}, {}, "done"},
                     {"line", I{2}, {}, {}, {}, "failed"},
                     {"ring", I{4}, 3.0, {}, {}, "done"}});
  add_speedups(table, "processors");
  EXPECT_EQ(table.rows[0][3], Value(8.0 / 2.5));
  EXPECT_EQ(table.rows[0][4], Value(8.0 / 2.5 / 4));
  EXPECT_EQ(table.rows[1][3], Value(1.0));
  EXPECT_EQ(table.rows[3][3], Value(3.0));
  EXPECT_EQ(table.rows[4][3], Value()) << "did not end";
  EXPECT_EQ(table.rows[5][3], Value()) << "no ring of one";
}

TEST(ExperimentsSpeedups, NeedAnAxisOfProcessors) {
  auto table = make({{"mesh", I{1}, 8.0, {}, {}, "done"}});
  table.axes = 1;
  add_speedups(table, "processors");
  EXPECT_EQ(table.rows[0][3], Value());
}

}  // namespace
}  // namespace laboratory

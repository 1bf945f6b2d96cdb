// Descriptions of a machine's state for live pages: loads and activities.
#include "experiments/laboratory/live/machine_state.hpp"

#include <gtest/gtest.h>

#include "experiments/laboratory/live/spans.hpp"
#include "tests/laboratory/support/two_processors.hpp"

namespace laboratory {
namespace {

using nlohmann::ordered_json;

struct Portrait : testing::Test {
  occam::Lab lab{occam::make_exact_model(), machine::Code::bare, {.links = machine::Links::direct}};
};

// Loads are in thousandths of the elapsed time. One processor computes for a quarter of the run,
// the other for half of it. The link transfers for a quarter.
TEST_F(Portrait, LoadsAreThereFromTheBeginningAndFollowTheRun) {
  start_two_processors(lab);
  RecentLoads loads;
  const auto describe = [&] {
    loads.update(lab.machine, lab.machine.now().value);
    return loads.describe(lab.machine, lab.machine.now().value);
  };
  const auto begun = describe();
  EXPECT_EQ(begun.at("cpus"), ordered_json({0, 0}));
  EXPECT_EQ(begun.at("links"), ordered_json({0, 0}));
  lab.machine.run();
  const auto ended = describe();
  EXPECT_EQ(ended.at("cpus"), ordered_json({250, 500}));
  EXPECT_EQ(ended.at("links"), ordered_json({250, 0}));
  EXPECT_NEAR(loads.mean_cpu(), 0.375, 1e-5);
  EXPECT_NEAR(loads.max_link(), 0.25, 1e-5);
  EXPECT_EQ(describe(), ended) << "no time has passed";
}

// Adjacent spans of the same activity are merged, unless take() has already returned the first one.
TEST_F(Portrait, SpansThatAreTakenAreToldOnce) {
  auto& first = lab.cpu();
  auto& second = lab.cpu();
  Spans spans;
  const auto ran = [&](const machine::Processor& on, double from_s, double to_s) {
    spans.ran(on, 0, machine::Observer::Doing::low, {from_s}, {to_s});
  };
  ran(first, 0, 1);
  ran(first, 1, 2);
  EXPECT_EQ(spans.take(), ordered_json({0, 1, 0, 2}));
  ran(first, 2, 3);
  ran(second, 3, 4);
  EXPECT_EQ(spans.take(), ordered_json({0, 1, 2, 3, 1, 1, 3, 4}));
  ran(second, 4, 5);
  EXPECT_EQ(spans.take(), ordered_json({1, 1, 4, 5}));
  EXPECT_EQ(spans.take(), ordered_json::array());
}

}  // namespace
}  // namespace laboratory

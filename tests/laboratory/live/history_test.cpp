// Bounds and completeness of the history of a live run.
#include "experiments/laboratory/live/history.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace laboratory {
namespace {

TEST(LiveHistory, APageGetsWhatItLacks) {
  History history;
  History::Place early, late;
  EXPECT_TRUE(history.take_after(early).is_null());
  history.add_sample(0, {1, NAN});
  history.add_action({{"t_s", 0.5}});
  EXPECT_EQ(history.take_after(early).dump(),
            R"({"stride":1,"samples":[[1,0.0,1.0,null]],"actions":[{"t_s":0.5}]})");
  history.add_sample(1, {2, 3});
  history.add_sample(1, {4, 5});  // replaces the sample of the same time
  EXPECT_EQ(history.take_after(early).dump(),
            R"({"stride":1,"samples":[[3,1.0,4.0,5.0]],"actions":[]})");
  EXPECT_EQ(history.take_after(late).at("samples").size(), 2u);
  EXPECT_EQ(late.samples, early.samples);
}

// The samples that remain are evenly spread.
TEST(LiveHistory, IsThinnedAboveItsBound) {
  History history;
  constexpr int COUNT = 10'000, STRIDE = 8;
  for (int i = 0; i < COUNT; ++i) {
    history.add_sample(i, {});
    history.add_action({{"t_s", i}});
  }
  History::Place none;
  const auto all = history.take_after(none);
  EXPECT_EQ(all.at("stride"), STRIDE);
  const auto& samples = all.at("samples");
  EXPECT_EQ(samples.front()[1], 0);
  EXPECT_EQ(samples.back()[1], COUNT - 1);
  EXPECT_EQ(samples.size(), COUNT / STRIDE + 1u);
  for (std::size_t i = 1; i < samples.size(); ++i)
    EXPECT_LE(samples[i][1].get<double>() - samples[i - 1][1].get<double>(), STRIDE);
  const auto& actions = all.at("actions");
  ASSERT_EQ(actions.size(), History::MOST_ACTIONS);
  EXPECT_EQ(actions.back().at("t_s"), COUNT - 1);
}

TEST(LiveHistory, ANewMachineBeginsAnew) {
  History history;
  History::Place page;
  history.add_sample(5, {});
  history.take_after(page);
  history.clear_samples();
  history.add_sample(0, {});
  EXPECT_EQ(history.take_after(page).at("samples").dump(), "[[2,0.0]]");
}

}  // namespace
}  // namespace laboratory

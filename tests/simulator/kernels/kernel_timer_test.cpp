// Timing of kernels, with a fake clock that only these tests advance.
#include "simulator/kernels/kernel_timer.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "simulator/kernels/kernels.hpp"

namespace kernels {
namespace {

constexpr double INTERVAL_S = 0.7e-6;

constexpr double CALL_S = 3e-9, YARDSTICK_S = 40e-6;

// A host whose clock advances by INTERVAL_S at each reading. `slowness` is a factor on the duration
// of all calls, as if other programs slowed the host down.
struct FakeHost {
  double at_s = 0, slowness = 1;
  int readings = 0;
  Host host{[this] { return ++readings, at_s += INTERVAL_S; },
            [this] { at_s += slowness * YARDSTICK_S; }, INTERVAL_S, CALL_S, YARDSTICK_S};

  // Returns a call that takes `s` seconds.
  std::function<void()> take(double s) {
    return [this, s] { at_s += slowness * (s + CALL_S); };
  }
};

TEST(KernelTimer, ALongCallTakesWhatItTakesWithoutTheClock) {
  FakeHost host;
  KernelTimer timer(host.host);
  for (const double s : {3e-3, 2e-3, 7e-3}) EXPECT_NEAR(timer.eval(host.take(s), 1), s, 1e-12);
  EXPECT_FALSE(timer.is_short());
}

// Two of the five repetitions of a batch are disturbed. The median must not change.
TEST(KernelTimer, WhatOtherProgramsAddNowAndThenIsMetByRepetition) {
  FakeHost host;
  KernelTimer timer(host.host);
  int run = 0;
  const auto replay = [&] { host.at_s += (++run % 3 == 0 ? 4e-3 : 3e-3) + CALL_S; };
  for (int i = 0; i < 10; ++i) EXPECT_NEAR(timer.eval(replay, 1), 3e-3, 1e-12);
}

// Long disturbances also slow the yardstick (the reference workload), so the measured time must not
// change.
TEST(KernelTimer, ASlowerHostIsMetByTheYardstick) {
  FakeHost host;
  KernelTimer timer(host.host);
  for (const double slowness : {1.0, 1.4, 0.9, 3.0}) {
    host.slowness = slowness;
    EXPECT_NEAR(timer.eval(host.take(1e-3), 1), 1e-3, 1e-12);
  }
}

// Each call is shorter than a clock reading. The sum of their times must nevertheless be right, and
// there must be fewer clock readings than calls.
TEST(KernelTimer, ShortCallsAreMeasuredTogether) {
  FakeHost host;
  KernelTimer timer(host.host);
  const int calls = 20000;
  double sum_s = 0;
  for (int i = 0; i < calls; ++i) sum_s += timer.eval(host.take(0.1e-6), 1);
  EXPECT_NEAR(sum_s, calls * 0.1e-6, 1e-9);
  EXPECT_LT(host.readings, calls);
  EXPECT_FALSE(timer.is_short());
  EXPECT_NEAR(timer.longest_batch_s(), KernelTimer::MOST_CALLS * 0.1e-6, 1e-9);
}

// The time of a batch must be shared among its calls by weight. A batch must end when it is long
// enough.
TEST(KernelTimer, CallsOfABatchShareItByWeight) {
  FakeHost host;
  KernelTimer timer(host.host);
  double sum_s = 0;
  int calls = 0;
  for (; calls < 3000; ++calls) {
    const int weight = 1 + calls % 3;
    const double s = timer.eval(host.take(40e-6 * weight), weight);
    EXPECT_NEAR(s, 40e-6 * weight, 1e-11);
    sum_s += s;
  }
  EXPECT_NEAR(sum_s, calls * 80e-6, 1e-8);
  EXPECT_LT(timer.longest_batch_s(), KernelTimer::BATCH_S + 120e-6);
}

// The time per unit of weight decreases, so each batch charges too much. The next batch must deduct
// the difference, a part of it from each call.
TEST(KernelTimer, ChargesAllThatBatchesTook) {
  FakeHost host;
  KernelTimer timer(host.host);
  double sum_s = 0, taken_s = 0;
  const int calls = 20000;
  for (int i = 0; i < calls; ++i) {
    const double s = 60e-6 * (2 - static_cast<double>(i) / calls);
    const double charged_s = timer.eval(host.take(s), 1);
    EXPECT_NEAR(charged_s, s, 0.25 * s);
    taken_s += s;
    sum_s += charged_s;
  }
  EXPECT_NEAR(sum_s / taken_s, 1, 1e-5);
}

// Overcharges must be returned in parts, so that no call is charged less than zero.
TEST(KernelTimer, GivesBackInParts) {
  FakeHost host;
  KernelTimer timer(host.host);
  for (int i = 0; i < 20000; ++i)
    ASSERT_GT(timer.eval(host.take(i % 2000 < 1000 ? 60e-6 : 2e-6), 1), 0) << i;
}

// If calls take twice as long from some moment on, the charges must follow within one batch.
TEST(KernelTimer, FollowsWhatCallsTake) {
  FakeHost host;
  KernelTimer timer(host.host);
  for (int i = 0; i < 5000; ++i) timer.eval(host.take(1e-6), 1);
  double s = 0;
  for (std::size_t i = 0; i < 6 * KernelTimer::MOST_CALLS; ++i) s = timer.eval(host.take(2e-6), 1);
  EXPECT_NEAR(s, 2e-6, 1e-12);
}

// There are too few calls for a batch that is long enough for the clock. They must be measured
// nevertheless, and the timer must report that they were few.
TEST(KernelTimer, KnowsKernelsThatAreTooShort) {
  FakeHost host;
  KernelTimer timer(host.host);
  for (int i = 0; i < 21; ++i) EXPECT_NEAR(timer.eval(host.take(1e-6), 1), 1e-6, 1e-9);
  EXPECT_TRUE(timer.is_short());
  EXPECT_NEAR(timer.longest_batch_s(), 16e-6, 1e-9);
}

// A batch with the maximum number of calls must count as long enough, however short its time is.
TEST(KernelTimer, AWholeBatchIsNotTooShort) {
  FakeHost host;
  KernelTimer timer(host.host);
  for (std::size_t i = 0; i < 2 * KernelTimer::MOST_CALLS; ++i) timer.eval(host.take(1e-12), 1);
  EXPECT_FALSE(timer.is_short());
}

TEST(KernelTimer, ThisHostsClockMovesWithItsThread) {
  const auto& host = this_host();
  EXPECT_GT(host.interval_s, 0);
  EXPECT_GT(host.yardstick_s, 0);
  const double start_s = host.now_s();
  double end_s = start_s;
  for (int i = 0; i < 1'000'000 && end_s == start_s; ++i) end_s = host.now_s();
  EXPECT_GT(end_s, start_s);
}

TEST(KernelUse, ThoseTooShortAreNamed) {
  KernelUse good{.name = "ray", .calls = 1000, .host_s = 1e-3};
  KernelUse brief{.name = "settle", .calls = 4, .host_s = 8e-6};
  brief.is_short = true;
  brief.longest_batch_s = 6e-6;
  const auto notes = note_short({good, brief});
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_TRUE(notes[0].starts_with("timed: the kernel \"settle\" (4 calls of 2 us) is too short"))
      << notes[0];
  EXPECT_NE(notes[0].find("found 6 us for the longest batch of calls"), std::string::npos)
      << notes[0];
  const double least_us = KernelTimer::LEAST_INTERVALS * (1e6 * clock_interval_s());
  EXPECT_NE(notes[0].find(fmt::format("expected {:.3g} us", least_us)), std::string::npos)
      << notes[0];
  std::smatch reading;  // matches any clock interval below a second
  ASSERT_TRUE(std::regex_search(notes[0], reading, std::regex("[(]resolution ([0-9.e+-]+) us[)]")));
  EXPECT_LT(std::stod(reading[1]), 1e6);
}

}  // namespace
}  // namespace kernels

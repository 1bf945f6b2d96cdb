// The order of handling events.
#include "simulator/machine/carriers/events.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace machine {
namespace {

// Events must be handled in the order of their dates. At equal dates, events of first_at() must
// precede those of at(), and events of one kind must keep the order of scheduling.
TEST(Events, ComeByDateAndThenAsTheyWereAskedFor) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random{seed};
    struct Asked {
      double date;
      bool is_other;  // true if scheduled by at(), not by first_at()
      int number;
      auto operator<=>(const Asked&) const = default;
    };
    std::vector<Asked> asked, came;
    Events events;
    const int number = 1 + static_cast<int>(random() % 300);
    for (int i = 0; i < number; ++i) {
      asked.push_back({0.1 * static_cast<double>(random() % 20), random() % 2 == 0, i});
      const auto note = [&came, what = &asked, i] {
        came.push_back((*what)[static_cast<std::size_t>(i)]);
      };
      asked.back().is_other ? events.at(asked.back().date, note)
                            : events.first_at(asked.back().date, note);
    }
    while (events.next() < Events::NEVER) events.handle_next();
    std::ranges::sort(asked);
    EXPECT_TRUE(came.size() == asked.size() && std::ranges::equal(came, asked));
  }
}

// Callbacks of soon() must run after the event, in order, including those that other callbacks of
// soon() schedule. None may run after a stop.
TEST(Events, WhatIsAskedForSoonComesUntilAStop) {
  struct Trial {
    Events events;
    std::vector<int> came = {};
    int stop_at;
    void soon(int number) {
      came.push_back(number);
      if (number == stop_at) events.stop(Events::End::stopped);
      if (number < 4)
        for (const int next : {2 * number + 1, 2 * number + 2})
          events.soon([this, next] { soon(next); });
    }
  };
  for (const int stop_at : {9, 8, 5, 1, 0}) {
    Trial trial{.events = {}, .stop_at = stop_at};
    trial.events.at(1, [&trial] { trial.soon(0); });
    trial.events.handle_next();
    std::vector<int> expected(static_cast<std::size_t>(std::min(stop_at, 8) + 1));
    std::iota(expected.begin(), expected.end(), 0);
    EXPECT_EQ(trial.came, expected);
  }
}

}  // namespace
}  // namespace machine

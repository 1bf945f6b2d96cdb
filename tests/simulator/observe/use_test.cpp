// Use of resources between two dates, compared with values calculated by hand.
#include "simulator/observe/use.hpp"

#include <gtest/gtest.h>

#include <random>

namespace observe {
namespace {

// Makes a Use with random numbers for two processors, three link directions and two processes. No
// number is lower than in `before`.
Use make_use(std::mt19937_64& random, const Use& before) {
  const auto more = [&] { return static_cast<double>(random() % 100); };
  const auto count = [&] { return random() % 100; };
  Use use = before;
  use.cpus.resize(2);
  use.links.resize(3);
  use.processes.resize(2);
  use.time_s += more();
  for (auto& cpu : use.cpus) {
    cpu.busy_s += more();
    cpu.busy_high_s += more();
    cpu.preemptions += count();
    cpu.dispatches += count();
  }
  for (auto& link : use.links) {
    link.busy_s += more();
    link.messages += count();
    link.bytes += count();
  }
  for (std::size_t i = 0; i < use.processes.size(); ++i) {
    auto& process = use.processes[i];
    process.id = i + 1;
    process.output_s += more();
    process.input_s += more();
    process.alternative_s += more();
  }
  return use;
}

TEST(Use, BetweenTwoInstantsIsTheDifferenceOfAllCounts) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    const Use before = make_use(random, {}), after = make_use(random, before);
    const Use found = between(before, after);
    EXPECT_EQ(found.time_s, after.time_s - before.time_s);
    for (std::size_t i = 0; i < 2; ++i) {
      const auto &a = before.cpus[i], &b = after.cpus[i], &f = found.cpus[i];
      EXPECT_EQ(f.busy_s, b.busy_s - a.busy_s);
      EXPECT_EQ(f.busy_high_s, b.busy_high_s - a.busy_high_s);
      EXPECT_EQ(f.preemptions, b.preemptions - a.preemptions);
      EXPECT_EQ(f.dispatches, b.dispatches - a.dispatches);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const auto &a = before.links[i], &b = after.links[i], &f = found.links[i];
      EXPECT_EQ(f.busy_s, b.busy_s - a.busy_s);
      EXPECT_EQ(f.messages, b.messages - a.messages);
      EXPECT_EQ(f.bytes, b.bytes - a.bytes);
    }
    for (std::size_t i = 0; i < 2; ++i) {
      const auto &a = before.processes[i], &b = after.processes[i], &f = found.processes[i];
      EXPECT_EQ(f.output_s, b.output_s - a.output_s);
      EXPECT_EQ(f.input_s, b.input_s - a.input_s);
      EXPECT_EQ(f.alternative_s, b.alternative_s - a.alternative_s);
    }
  }
}

}  // namespace
}  // namespace observe

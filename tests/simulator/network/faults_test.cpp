// Faults of the simulated program, which must end the run with a clear message.
#include <gtest/gtest.h>

#include "base/errors.hpp"
#include "tests/simulator/machine/failures.hpp"

namespace occam {
namespace {

TEST(Memory, OutOfMemoryNamesBytesAskedForAndAvailable) {
  expect_failure(
      "OutOfMemory of cpu 0 at 1024",
      {"cpu 0 is out of memory", "scene asked for 1000000 bytes", "48476 of 1048576 are available"},
      [](Lab& lab) {
        auto& cpu = lab.cpu();
        cpu.start("loader", Priority::low, [&] {
          wait_until(1);
          cpu.memory().allocate(1'000'100, "program", this_process().now());
          cpu.memory().allocate(1'000'000, "scene", this_process().now());
        });
      });
}

TEST(Memory, CountsWhatIsUsedAndItsPeak) {
  machine::Memory memory("cpu", 100);
  memory.allocate(60, "a", {});
  memory.allocate(40, "b", {});
  EXPECT_THROW(memory.allocate(1, "c", {}), machine::OutOfMemory);
  memory.release(70);
  memory.allocate(20, "d", {});
  EXPECT_THROW(memory.allocate(~std::uint64_t{0}, "e", {}), machine::OutOfMemory);
  EXPECT_EQ(memory.used(), 50u);
  EXPECT_EQ(memory.peak(), 100u);
  EXPECT_EQ(memory.size(), 100u);
}

TEST(Failure, OfAProcessEndsTheSimulationAndIsThrownAgain) {
  for (auto priority : BOTH_PRIORITIES)
    expect_failure("runtime_error", {"no such object"}, [&](Lab& lab) {
      auto& a = lab.cpu();
      auto& b = lab.neighbour(a);
      auto& channel = lab.hard(a, b);
      b.start("partner", priority, [&] { channel.in(), channel.in(); });
      a.start("faulty", priority, [&] {
        out(channel, Words{10'000});
        compute(100);
        throw std::runtime_error("no such object");
      });
      a.start("endless", Priority::low, [] {
        for (;;) compute(1000), this_process().sync();
      });
    });
}

TEST(Invariant, OfTheMachineIsChecked) {
  expect_failure("base::InvariantBroken", {"Alice was made ready, but it was not waiting"},
                 [](Lab& lab) {
                   auto& cpu = lab.cpu();
                   cpu.make_ready(cpu.start("Alice", Priority::low, [] {}), {});
                 });
  EXPECT_THROW(this_process(), base::InvariantBroken);
  EXPECT_THROW(compute(1), base::InvariantBroken);
  EXPECT_NO_THROW(base::check_equal("things", 2, 2));
  EXPECT_THROW(base::check_equal("things", 2, 3), base::InvariantBroken);
}

}  // namespace
}  // namespace occam

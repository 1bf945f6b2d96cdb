// What goes wrong says so: deadlock, memory, failing processes, broken invariants.
#include <gtest/gtest.h>

#include "simulator/machine/faults.hpp"
#include "tests/simulator/support.hpp"

namespace occam {
namespace {

// Runs a machine that fails. The first line of the answer: the type of what was thrown, and of
// whom and at what cycle a fault is; the rest is the message.
std::string failure_of(const std::function<void(Lab&)>& body) {
  return isolated([&]() -> std::string {
    Lab lab;
    auto fault = [&](const char* type, const machine::Fault& e) {
      const double cycle = e.when.value * lab.machine.model().cpu.clock.value;
      return fmt::format("{} of {} at {}\n{}", type, e.who, cycle, e.what());
    };
    try {
      body(lab);
      lab.machine.run();
    } catch (const machine::Deadlock& e) {
      return fault("Deadlock", e);
    } catch (const machine::OutOfMemory& e) {
      return fault("OutOfMemory", e);
    } catch (const machine::InvariantBroken& e) {
      return fmt::format("InvariantBroken\n{}", e.what());
    } catch (const std::runtime_error& e) {
      return fmt::format("runtime_error\n{}", e.what());
    }
    return "nothing\n";
  });
}

void expect_failure(const std::string& first_line, const std::vector<std::string>& parts,
                    const std::function<void(Lab&)>& body) {
  const std::string failure = failure_of(body);
  const auto end = failure.find('\n');
  EXPECT_EQ(failure.substr(0, end), first_line);
  for (const auto& part : parts)
    EXPECT_NE(failure.find(part, end), std::string::npos)
        << "no \"" << part << "\" in: " << failure;
}

std::string deadlock_at(Cycles cycle) {
  return fmt::format("Deadlock of machine at {}", cycle.value);
}

TEST(Deadlock, NamesProcessesAndChannels) {
  const Model costs = make_exact_model();
  // Two processes each wait for the other to input first.
  for (auto priority : BOTH_PRIORITIES)
    expect_failure(deadlock_at(2 * costs.channel.blocked),
                   {"deadlock at 0.000002 s", "\n  Alice waits for out on soft 0",
                    "\n  Bob waits for out on soft 1"},
                   [&](Lab& lab) {
                     auto &there = lab.soft(), &back = lab.soft();
                     auto& cpu = lab.cpu();
                     cpu.start("Alice", priority, [&] { out(there, Words{}), back.in(); });
                     cpu.start("Bob", priority, [&] { out(back, Words{}), there.in(); });
                     cpu.start("Carol", priority, [] {});
                   });
  EXPECT_EQ(failure_of([](Lab& lab) { lab.cpu().start("Carol", Priority::low, [] {}); }),
            "nothing\n");
}

TEST(Deadlock, NamesTheChannelsOfAnAlt) {
  const auto alt = make_exact_model().alternative;
  const Cycles waits = alt.setup + alt.wait_not;
  auto wait = [](Lab& lab, std::size_t guards) {
    auto &a = lab.soft(), &b = lab.soft();
    lab.cpu().start("Alice", Priority::low, [&, guards] {
      const std::array<Guard, 2> all{Guard{&a}, Guard{&b}};
      select(std::span(all).first(guards));
    });
  };
  expect_failure(deadlock_at(waits + alt.enable_not), {"Alice waits for alt on", "soft 0"},
                 [&](Lab& lab) { wait(lab, 1); });
  expect_failure(deadlock_at(waits + 2 * alt.enable_not),
                 {"Alice waits for alt on", "soft 0", "soft 1"}, [&](Lab& lab) { wait(lab, 2); });
}

TEST(Deadlock, OfALinkNamesItsEnds) {
  expect_failure(deadlock_at(make_exact_model().channel.blocked),
                 {"Alice waits for in on cpu 0 > cpu 1"}, [](Lab& lab) {
                   auto& a = lab.cpu();
                   auto& b = lab.neighbour(a);
                   auto& channel = lab.hard(a, b);
                   b.start("Alice", Priority::low, [&] { channel.in(); });
                 });
}

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

TEST(Invariant, IsCheckedWherePartnersAreNotTwo) {
  auto twice = [](bool writes, bool hard) {
    return [=](Lab& lab) {
      auto& a = lab.cpu();
      auto& b = lab.neighbour(a);
      auto& channel = hard ? lab.hard(a, b) : lab.soft();
      for (int i = 0; i < 2; ++i)
        (writes ? a : b).start("twin", Priority::high, [&channel, writes] {
          writes ? out(channel, Words{}) : void(channel.in());
        });
    };
  };
  for (bool hard : {false, true}) {
    const std::string name = hard ? "cpu 0 > cpu 1" : "soft 0";
    expect_failure("InvariantBroken", {"two processes output on channel " + name},
                   twice(true, hard));
    expect_failure("InvariantBroken", {"two processes input on channel " + name},
                   twice(false, hard));
  }
  expect_failure("InvariantBroken", {"two messages at once on link cpu 0 > cpu 1"}, [](Lab& lab) {
    auto& a = lab.cpu();
    auto& b = lab.neighbour(a);
    for (int i = 0; i < 2; ++i) {
      auto& channel = lab.hard(a, b);
      a.start("writer", Priority::low, [&] { out(channel, Words{1000}); });
      b.start("reader", Priority::low, [&] { channel.in(); });
    }
  });
}

TEST(Invariant, OfTheMachineIsChecked) {
  expect_failure("InvariantBroken", {"cpu 0 would have more than four links"}, [](Lab& lab) {
    auto& hub = lab.cpu();
    for (int i = 0; i < 5; ++i) lab.neighbour(hub);
  });
  expect_failure("InvariantBroken", {"no link joins cpu 0 and cpu 1"}, [](Lab& lab) {
    auto &a = lab.cpu(), &b = lab.cpu();
    lab.machine.link(a, b);
  });
  expect_failure("InvariantBroken", {"Alice was made ready but is not waiting"}, [](Lab& lab) {
    auto& cpu = lab.cpu();
    cpu.make_ready(cpu.start("Alice", Priority::low, [] {}), {});
  });
  expect_failure("InvariantBroken", {"Alice: an ALT without an open guard"}, [](Lab& lab) {
    auto& channel = lab.soft();
    lab.cpu().start("Alice", Priority::low, [&] { select(std::array{Guard{&channel, false}}); });
  });
  EXPECT_THROW(this_process(), machine::InvariantBroken);
  EXPECT_THROW(compute(1), machine::InvariantBroken);
  EXPECT_NO_THROW(machine::check_equal("things", 2, 2));
  EXPECT_THROW(machine::check_equal("things", 2, 3), machine::InvariantBroken);
}

}  // namespace
}  // namespace occam

// Cycles that the DMA of links takes from CPUs.
#include <gtest/gtest.h>

#include <random>

#include "tests/support/lab.hpp"

namespace occam {
namespace {

double cycles_to_move(const Model& model, std::uint64_t bytes) {
  return static_cast<double>(bytes) / model.link.one_way_rate * model.cpu.clock.value;
}

// High-priority processes send a message from processor 0 to 1. At the same time, a low-priority
// process computes on each of the two processors. Returns the ends of the two computations and of
// the run, in cycles.
Numbers compute_beside_transfer(const Model& model, std::int64_t cycles, std::uint64_t bytes) {
  return isolated_numbers([&] {
    Lab lab(model);
    Processor& from = lab.cpu();
    Processor& to = lab.neighbour(from);
    auto& channel = lab.hard(from, to);
    Numbers ends(2);
    from.start("writer", Priority::high, [&] { out(channel, {bytes}); });
    to.start("reader", Priority::high, [&] { channel.in(); });
    for (int i = 0; i < 2; ++i)
      lab.machine.processors()[i]->start("busy", Priority::low, [&, i] {
        compute(cycles);
        this_process().sync();
        ends[i] = own_cycles();
      });
    lab.machine.run();
    ends.push_back(lab.cycles());
    return ends;
  });
}

// A computation of C cycles must end channel.blocked + C / (1 - share) cycles after its start.
// `share` is the fraction of the cycles that DMA takes.
TEST(Dma, SlowsAComputationDownByItsShareWhileWordsMove) {
  const Model model = make_stealing_model();
  const std::int64_t cycles = 31 * 1000;
  const auto found = compute_beside_transfer(model, cycles, 10'000);
  const auto blocked = model.channel.blocked.value;
  for (int end : {0, 1}) EXPECT_NEAR(found.at(end), blocked + cycles * 32 / 31, ROUNDING);
  EXPECT_NEAR(found.at(2), blocked + cycles_to_move(model, 10'000), ROUNDING);
}

// A computation that lasts longer than the message must take its own cycles, the cost of starting
// the message, and STEAL_WORD cycles for each word. Two switches follow when the message has
// arrived.
TEST(Dma, TakesItsCyclesFromAComputationThatLastsLonger) {
  const std::int64_t cycles = 200'000, words = 1000;
  for (const Model& model : {make_stealing_model(), machine::load_model("t805-25"),
                             machine::load_model("t414-20"), machine::load_model("t805-30")}) {
    const auto found = compute_beside_transfer(model, cycles, 4 * words);
    const auto& s = model.scheduler;
    // The time needs a tolerance: in all models but the exact one, the message's end is resolved
    // only to a picosecond.
    EXPECT_EQ(model.memory.steal_word, STEAL_WORD) << model.name;
    EXPECT_NEAR(found.at(0),
                cost_first(model, Side::writer, 4 * words) + cycles + words * STEAL_WORD +
                    (s.preemption + s.return_to_low).value,
                1e-3)
        << model.name;
    // The reader came first. The cost of its operands is the same with and without outword.
    EXPECT_NEAR(found.at(1), found.at(0), 1e-3) << model.name;
  }
}

// A process reaches an ALT while it still owes charged cycles to the clock. A message slows the CPU
// down, so the debt seems to last until after the timeout's tick. The message ends early, however.
// The ALT must wait for the tick; if it has a SKIP guard, it must take SKIP rather than the
// timeout.
TEST(Dma, EndsBeforeAnAltIsPaidFor) {
  constexpr double TICK = 1024;  // length of a tick in cycles
  constexpr std::int64_t MOST_OWED = 1000, BEFORE = 64;
  constexpr double ALT = 200;  // upper bound in cycles, including the reader and its message
  Model model = make_stealing_model();
  model.memory.steal_word = 16;
  for (const bool may_skip : {false, true})
    for (auto priority : BOTH_PRIORITIES)
      for (std::int64_t owes = 500; owes < MOST_OWED; owes += 12) {
        SCOPED_TRACE(
            fmt::format("{} owes {}{}", name_of(priority), owes, may_skip ? ", or SKIP" : ""));
        const auto found = isolated_numbers([&] {
          Lab lab(model);
          Processor& a = lab.cpu();
          Processor &b = lab.neighbour(a), &c = lab.neighbour(a);
          auto &never = lab.hard(b, a), &slows = lab.hard(c, a);
          a.start("reader", Priority::high, [&] { slows.in(); });
          c.start("writer", Priority::high, [&] { out(slows, {10}); });
          double end = 0;
          bool skipped = false;
          a.start("waits", priority, [&] {
            compute(BEFORE);
            this_process().sync();  // the message has started by then
            compute(owes);
            auto tick = after(priority == Priority::high ? 64 : 1, [] {});
            Words message;
            if (may_skip)
              pri_alt(tick, otherwise(true, [&] { skipped = true; }));
            else
              pri_alt(when(never, message, [] {}), tick);
            end = own_cycles();
          });
          lab.machine.run();
          return Numbers{static_cast<double>(skipped), end};
        });
        ASSERT_EQ(found.size(), 2u);
        const bool skipped = found[0] == 1;
        if (!skipped) {
          EXPECT_GE(found[1], TICK);
        }
        const auto paid = static_cast<double>(BEFORE + owes);
        EXPECT_LE(found[1], (skipped ? paid : std::max(paid, TICK)) + ALT);
      }
}

// Messages overlap on several links, in both directions. Every word must take cycles from the CPUs
// at both its ends, whatever the order of the messages.
TEST(Dma, EveryWordOfEveryLinkAndDirectionTakesItsCycles) {
  struct Flow {
    int from, to;
    std::uint64_t bytes;
  };
  const std::vector<Flow> tests[] = {
      {{0, 1, 4000}, {1, 0, 3600}},
      {{0, 1, 4000}, {1, 0, 400}},
      {{0, 1, 4000}, {0, 2, 8000}},
      {{0, 1, 400}, {1, 0, 4000}, {0, 2, 8000}, {2, 0, 4}, {3, 0, 1600}, {0, 4, 44}},
  };
  const std::int64_t cycles = 1'000'000;
  const Model model = make_stealing_model();
  const auto& s = model.scheduler;
  for (const auto& flows : tests) {
    const auto found = isolated_numbers([&] {
      Lab lab(model);
      Processor& hub = lab.cpu();
      for (int i = 0; i < 4; ++i) lab.neighbour(hub);
      const auto& cpus = lab.machine.processors();
      for (const Flow& flow : flows) {
        auto& channel = lab.hard(*cpus[flow.from], *cpus[flow.to]);
        cpus[flow.from]->start("writer", Priority::high, [&] { out(channel, {flow.bytes}); });
        cpus[flow.to]->start("reader", Priority::high, [&] { channel.in(); });
      }
      double end = 0;
      hub.start("busy", Priority::low, [&] {
        compute(cycles);
        this_process().sync();
        end = own_cycles();
      });
      lab.machine.run();
      return Numbers{end, static_cast<double>(hub.use().preemptions)};
    });
    double expected = static_cast<double>(cycles);
    for (const Flow& flow : flows)
      expected +=
          static_cast<double>(model.channel.blocked.value + words_in(flow.bytes) * STEAL_WORD);
    // There are fewer pre-emptions than messages if a message ends before the computation begins,
    // or if two messages end at once.
    expected += found.at(1) * static_cast<double>((s.preemption + s.return_to_low).value);
    EXPECT_LE(found.at(1), flows.size());
    EXPECT_GE(found.at(1), 1);
    EXPECT_NEAR(found.at(0), expected, ROUNDING);
  }
}

TEST(Dma, SlowsAHighPriorityProcessFromItsStart) {
  const Model model = make_stealing_model();
  const auto found = isolated_numbers([&] {
    Lab lab(model);
    Processor& from = lab.cpu();
    Processor& to = lab.neighbour(from);
    auto& channel = lab.hard(from, to);
    double end = 0;
    from.start("writer", Priority::high, [&] { out(channel, {10'000}); });
    to.start("reader", Priority::high, [&] { channel.in(); });
    from.start("busy", Priority::high, [&] {
      wait_until_cycle(4096);
      compute(31 * 100);
      end = own_cycles();
    });
    lab.machine.run();
    return Numbers{end};
  });
  EXPECT_EQ(found.at(0), 4096 + 32 * 100);
}

// A message ends during a computation of C cycles. From then on, DMA takes no cycles from the
// computation. now() must return C plus two cycles for each word, and at low priority also the
// cycles of two switches. A sync() before now() must change nothing.
TEST(Dma, NowIsExactBesideIt) {
  const Model model = make_stealing_model();
  constexpr std::int64_t charges = 10, cycles = 20'000, words = 1000;
  for (const auto priority : BOTH_PRIORITIES) {
    const auto end_of = [&](bool syncs) {
      return isolated_numbers([&] {
        Lab lab(model);
        Processor& from = lab.cpu();
        Processor& to = lab.neighbour(from);
        auto& channel = lab.hard(from, to);
        Numbers ends;
        from.start("writer", Priority::high, [&] { out(channel, {4 * words}); });
        to.start("reader", Priority::high, [&] { channel.in(); });
        from.start("busy", priority, [&] {
          for (int i = 0; i < charges; ++i) compute(cycles);
          if (syncs) this_process().sync();
          ends.push_back(own_cycles());
        });
        lab.machine.run();
        return ends;
      });
    };
    const auto& s = model.scheduler;
    const auto switches = priority == Priority::low ? s.preemption + s.return_to_low : Cycles{0};
    const auto end = model.channel.blocked + Cycles{charges * cycles + words * STEAL_WORD};
    EXPECT_NEAR(end_of(false).at(0), static_cast<double>((end + switches).value), ROUNDING);
    EXPECT_EQ(end_of(false), end_of(true)) << name_of(priority);
  }
}

// Context switches cost nothing here. A counting process of lowest priority must get all cycles
// that the other processes and DMA leave.
TEST(Dma, LeavesAMonitorWhatIsNotTaken) {
  Model model = make_stealing_model();
  model.scheduler.preemption = model.scheduler.return_to_low = {0};
  constexpr double END_S = 0.02;
  constexpr std::int64_t ROUND = 8;  // length of a counting round in cycles
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto run = [&](bool has_controller) {
      return isolated_numbers([&] {
        std::mt19937_64 random(seed);
        Lab lab(model);
        Processor& a = lab.cpu();
        Processor& b = lab.neighbour(a);
        auto &there = lab.hard(a, b), &back = lab.hard(b, a);
        const auto talk = [&](Channel<Words>& channel, Processor& from, Processor& to) {
          const std::uint64_t bytes = 4 * (1 + random() % 500);
          const auto gap = static_cast<std::int64_t>(random() % 3000);
          from.start("writer", Priority::high, [&channel, bytes, gap] {
            for (int i = 0; i < 10; ++i) compute(gap), out(channel, {bytes});
          });
          to.start("reader", Priority::high, [&channel] {
            for (int i = 0; i < 10; ++i) channel.in();
          });
        };
        talk(there, a, b);
        talk(back, b, a);
        Numbers found;
        std::array<std::int64_t, 2> rounds{};
        if (has_controller)
          for (std::size_t i : {0, 1})
            (i == 0 ? a : b).start("monitor", Priority::low, [&rounds, i] {
              for (;; ++rounds[i]) compute(ROUND), this_process().sync();
            });
        lab.machine.run({END_S});
        for (std::size_t i : {0, 1}) {
          const double taken_s = (i == 0 ? a : b).use().taken().value;
          found.push_back(has_controller ? static_cast<double>(rounds[i] * ROUND)
                                         : (END_S - taken_s) * model.cpu.clock.value);
        }
        return found;
      });
    };
    const Numbers counted = run(true), left = run(false);
    for (std::size_t i : {0, 1})
      EXPECT_NEAR(counted.at(i), left.at(i), 2 * ROUND) << "seed " << seed;
  }
}

// Random messages are sent during random computations. No cycle may be lost, and none taken twice.
TEST(Dma, ConservesCyclesUnderRandomTraffic) {
  const Model model = make_stealing_model();
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    std::uint64_t state = seed * 2 + 1;
    const auto random = [&] {
      return (state = state * 6364136223846793005u + 1442695040888963407u) >> 40;
    };
    std::vector<std::uint64_t> lengths;
    for (auto n = 1 + random() % 20; n > 0; --n) lengths.push_back(4 * (1 + random() % 100));
    const auto found = isolated_numbers([&] {
      Lab lab(model);
      Processor& a = lab.cpu();
      Processor& b = lab.neighbour(a);
      auto &there = lab.hard(a, b), &back = lab.hard(b, a);
      const auto gap = static_cast<std::int64_t>(random() % 500);
      const auto priority = [&] { return BOTH_PRIORITIES[random() % 2]; };
      for (auto* channel : {&there, &back}) {
        (channel == &there ? a : b).start("writer", priority(), [&, channel] {
          for (auto bytes : lengths) compute(gap), out(*channel, {bytes});
        });
        (channel == &there ? b : a).start("reader", priority(), [&, channel] {
          for (std::size_t i = 0; i < lengths.size(); ++i) channel->in();
        });
      }
      for (Processor* cpu : {&a, &b})
        for (int i = 0; i < 2; ++i)
          cpu->start("busy", Priority::low, [] { compute(1'000'000), this_process().sync(); });
      lab.machine.run();
      const auto n = static_cast<std::int64_t>(lengths.size());
      const auto charged = 2'000'000 + n * (gap + 2 * model.channel.blocked.value);
      Numbers found;
      for (Processor* cpu : {&a, &b}) {
        found.push_back(lab.busy_cycles(*cpu) - static_cast<double>(charged));
        found.push_back(static_cast<double>(cpu->use().preemptions));
      }
      return found;
    });
    std::int64_t words = 0;
    for (auto bytes : lengths) words += 2 * words_in(bytes);
    const auto& s = model.scheduler;
    for (std::size_t cpu : {0, 1}) {
      const double n = found.at(2 * cpu + 1), stolen = static_cast<double>(words * STEAL_WORD);
      const auto there = static_cast<double>(s.preemption.value),
                 back = static_cast<double>(s.return_to_low.value);
      // The switch back to a low-priority process may be cut short when the process loses the CPU
      // again.
      EXPECT_GE(found.at(2 * cpu), stolen + n * there - ROUNDING);
      EXPECT_LE(found.at(2 * cpu), stolen + n * (there + back) + ROUNDING);
    }
  }
}

}  // namespace
}  // namespace occam

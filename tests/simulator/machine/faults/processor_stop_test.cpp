// Processors that stop at a given cycle.
#include <gtest/gtest.h>

#include "base/errors.hpp"
#include "simulator/observe/use.hpp"
#include "tests/simulator/machine/failing_links.hpp"
#include "tests/simulator/machine/failures.hpp"

namespace occam {
namespace {

constexpr double STOP = 5000;  // cycle at which the processor stops

// Two processors with a link. The second one stops.
struct StoppedPair {
  StoppedPair() {
    lab.machine.connect(a, b);
    lab.machine.stop_processor(b, at_cycle(lab, STOP));
  }
  Lab lab;
  Processor& a = lab.cpu();
  Processor& b = lab.cpu();
};

auto computing(std::int64_t cycles, double& end) {
  return [cycles, &end] {
    compute(cycles);
    this_process().sync();
    end = own_cycles();
  };
}

// The stopped processor must count as busy until the stop and idle afterwards. Others must continue
// to their end.
TEST(ProcessorStop, EndsWhatItComputes) {
  for (auto priority : BOTH_PRIORITIES)
    for (std::int64_t elsewhere : {0, 20'000}) {
      const auto found = isolated_numbers([&] {
        StoppedPair pair;
        double end = -1, other = -1, never = -1;
        pair.b.start("computes", priority, computing(10'000, end));
        pair.b.start("waits for the CPU", Priority::low, computing(10'000, never));
        if (elsewhere > 0) pair.a.start("elsewhere", priority, computing(elsewhere, other));
        EXPECT_EQ(pair.lab.machine.run(), machine::End::done);
        EXPECT_TRUE(pair.b.stopped());
        EXPECT_FALSE(pair.a.stopped());
        observe::collect(pair.lab.machine);  // also checks invariants of the counts
        return Numbers{end, never, pair.lab.busy_cycles(pair.b), pair.lab.cycles()};
      });
      EXPECT_EQ(found, (Numbers{-1, -1, STOP, elsewhere > 0 ? 20'000 : STOP}));
    }
}

// The processor stops while a high-priority process is pre-empting the low-priority one, or while
// the CPU is switching back. The switch must be counted up to the stop.
TEST(ProcessorStop, CountsASwitchUpToTheInstant) {
  const auto& s = make_exact_model().scheduler;
  const auto there = s.preemption.value, back = s.return_to_low.value;
  for (std::int64_t computes : {STOP / 8 - there, STOP - 4096 - there, STOP - 4096 - there - 1,
                                STOP - 4096 - there - back + 1, 300.0}) {
    const auto found = isolated_numbers([&] {
      StoppedPair pair;
      double end = -1;
      pair.b.start("computes", Priority::low, computing(10'000, end));
      pair.b.start("interrupts", Priority::high, [=] {
        wait_until_cycle(4096);
        compute(computes);
        this_process().sync();
      });
      pair.lab.machine.run();
      return Numbers{end, pair.lab.busy_cycles(pair.b), pair.lab.cycles()};
    });
    EXPECT_EQ(found, (Numbers{-1, STOP, STOP})) << computes;
  }
}

// Timers of a stopped processor must neither fire nor postpone the end of the run.
TEST(ProcessorStop, ForgetsItsTimers) {
  for (auto priority : BOTH_PRIORITIES) {
    const auto found = isolated_numbers([&] {
      StoppedPair pair;
      double rung = 0;
      pair.b.start("waits", priority, [&] {
        wait_until_cycle(1 << 20);
        rung = 1;
      });
      EXPECT_EQ(pair.lab.machine.run(), machine::End::done);
      return Numbers{rung, pair.lab.cycles()};
    });
    EXPECT_EQ(found, (Numbers{0, STOP}));
  }
}

// Neighbours that wait or communicate must fail at the moment of the stop. Neighbours that start to
// communicate later must fail at once. Processes of the stopped processor itself must not receive a
// failure.
TEST(ProcessorStop, CutsItsLinks) {
  const auto blocked = static_cast<double>(make_exact_model().channel.blocked.value);
  for (auto priority : BOTH_PRIORITIES)
    for (auto side : {Side::writer, Side::reader})
      for (bool has_partner : {false, true})
        for (std::int64_t computes : {100, 9000}) {
          const auto found = isolated_numbers([&] {
            StoppedPair pair;
            // A neighbour that the stop does not concern.
            Processor& c = pair.lab.neighbour(pair.a);
            auto& channel = side == Side::writer ? pair.lab.hard(pair.a, pair.b)
                                                 : pair.lab.hard(pair.b, pair.a);
            const Side other = side == Side::writer ? Side::reader : Side::writer;
            Attempt near{pair.a, priority, side, channel, computes, 1000};
            Attempt far{pair.b, priority, other, channel, 0, 1000};
            near.start();
            if (has_partner) far.start();
            pair.lab.machine.run();
            EXPECT_FALSE(pair.lab.machine.link(pair.a, c).is_cut());
            EXPECT_TRUE(pair.lab.machine.link(pair.b, pair.a).is_cut());
            return Numbers{near.moved, near.end, far.moved, pair.lab.cycles()};
          });
          const double end = computes > STOP ? computes + blocked : STOP;
          EXPECT_EQ(found, (Numbers{0, end, -1, end})) << has_partner << computes;
        }
}

// Processes in soft channels and PARs of a stopped processor stay blocked, which is not a deadlock.
TEST(ProcessorStop, ItsProcessesStayWhereTheyAre) {
  const auto found = isolated_numbers([] {
    StoppedPair pair;
    auto &soft = pair.lab.soft(), &never = pair.lab.soft();
    double end = 0;
    pair.b.start("parent", Priority::low, [&] {
      par({{"branch", Priority::high, [&] { soft.in(); }},
           {"own", Priority::low, [&] { compute(10'000), out(soft, {}); }}});
      end = 1;
    });
    pair.b.start("waits", Priority::low, [&] { never.in(); });
    pair.a.start("elsewhere", Priority::low, computing(20'000, end));
    EXPECT_EQ(pair.lab.machine.run(), machine::End::done);
    return Numbers{end, pair.lab.cycles()};
  });
  EXPECT_EQ(found, (Numbers{20'000, 20'000}));
}

// A process on another processor waits for the stopped processor. It waits for ever, which is a
// deadlock.
TEST(ProcessorStop, LeavesADeadlockElsewhere) {
  const auto report = failure_of([](Lab& lab) {
    Processor& a = lab.cpu();
    Processor& b = lab.neighbour(a);
    auto& channel = lab.hard(b, a);
    lab.machine.stop_processor(b, at_cycle(lab, STOP));
    a.start("Alice", Priority::low, [&] { channel.in(); });
    b.start("Bob", Priority::low, [&] { compute(10'000), out(channel, {}); });
  });
  EXPECT_TRUE(report.starts_with("Deadlock of machine at 5000\n")) << report;
  EXPECT_TRUE(
      report.ends_with("any more:\n  Alice on cpu 0 waits for in on cpu 1 > cpu 0 "
                       "(link cut)"))
      << report;
}

// Callbacks of on_failure() must run before any other event of that date, even one scheduled
// earlier. They must run once for the stopped processor, not once for each of its links. They may
// plan further failures.
TEST(ProcessorStop, IsToldBeforeAnythingElseHappens) {
  const auto log = isolated([] {
    StoppedPair pair;
    Processor& c = pair.lab.neighbour(pair.a);
    auto& channel = pair.lab.hard(pair.a, pair.b);
    std::string log;
    auto& machine = pair.lab.machine;
    machine.stop_processor(pair.b, at_cycle(pair.lab, STOP + 1));
    machine.cut_link(pair.a, pair.b, at_cycle(pair.lab, STOP + 1));
    machine.on_failure([&](const machine::Failure& failure) {
      log += fmt::format("{} {}{}; ", failure.a->name(), failure.b ? failure.b->name() : "stopped",
                         machine.link(pair.a, pair.b).is_cut());
      if (!failure.b) machine.cut_link(pair.a, c, machine.now());
    });
    c.start("computes", Priority::low, [&] {
      compute(static_cast<std::int64_t>(STOP));
      this_process().sync();
      log += "computed; ";
    });
    pair.a.start("writer", Priority::high, [&] { log += channel.out_or_fail({}) ? "" : "told; "; });
    machine.run();
    return log;
  });
  EXPECT_EQ(log, "cpu 1 stoppedtrue; cpu 0 cpu 2true; told; computed; ");
}

TEST(ProcessorStop, MayBeAfterTheEnd) {
  const auto found = isolated_numbers([] {
    StoppedPair pair;
    double end = 0, told = 0;
    pair.lab.machine.on_failure([&](const machine::Failure&) { told = 1; });
    pair.b.start("computes", Priority::high, computing(4000, end));
    pair.lab.machine.run();
    return Numbers{end, told, pair.b.stopped() ? 1.0 : 0.0, pair.lab.cycles()};
  });
  EXPECT_EQ(found, (Numbers{4000, 0, 0, 4000}));
}

// DMA has delayed the start of a process that the stop then ends. The run must not last longer
// because of this.
TEST(ProcessorStop, EndsWhatDmaHasDelayed) {
  const auto ends = [](std::int64_t steal_word) {
    return isolated_numbers([&] {
      Model model = make_exact_model();
      model.memory.steal_word = steal_word;
      Lab lab(model);
      Processor& stopped = lab.cpu();
      Processor& other = lab.neighbour(stopped);
      auto &link = lab.hard(other, stopped), &never = lab.soft();
      stopped.start("reader", Priority::high, [&] { link.in(); });
      stopped.start("blocks", Priority::high, [&] {
        compute(500);
        never.in();
      });
      stopped.start("next", Priority::high, [&] { compute(10); });
      other.start("writer", Priority::high, [&] {
        compute(100);
        static_cast<void>(link.out_or_fail({4000}));
      });
      lab.machine.stop_processor(stopped, Cycles{530} / model.cpu.clock);
      lab.machine.run();
      return Numbers{lab.cycles()};
    });
  };
  EXPECT_EQ(ends(32), ends(0));
}

TEST(ProcessorStop, BadDatesAndLinksAreRefused) {
  expect_failure("base::InvariantBroken", {"found a failure planned for -1 s at 0 s"},
                 [](Lab& lab) { lab.machine.stop_processor(lab.cpu(), {-1}); });
  expect_failure("Misuse of cpu 0 at 0", {"no link joins cpu 0 and cpu 1"}, [](Lab& lab) {
    Processor& a = lab.cpu();
    lab.machine.cut_link(a, lab.cpu(), {});
  });
}

}  // namespace
}  // namespace occam

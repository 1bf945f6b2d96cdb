// Time slices: low-priority processes share the CPU.
#include <gtest/gtest.h>

#include <random>

#include "tests/simulator/machine/bursts.hpp"

namespace occam {
namespace {

// A period in which one low-priority process computes and no other low-priority process does.
struct Stretch {
  std::size_t process;
  double begin, end;
};

// Runs low-priority processes of random lengths. They compute in small pieces and log each piece.
// Returns what is wrong, or "".
std::string check_slices(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  constexpr std::int64_t piece = 16;
  const Model model = make_exact_model();
  const auto period = static_cast<double>(model.scheduler.slice.value);
  std::vector<std::int64_t> lengths(1 + random() % 6);
  for (auto& length : lengths) length = piece * (1 + static_cast<std::int64_t>(random() % 2000));
  return isolated([&] {
    Lab lab;
    Processor &pieces = lab.cpu(), &whole = lab.cpu();
    std::vector<Stretch> stretches;
    Numbers ends(lengths.size()), whole_ends(lengths.size());
    std::int64_t total = 0;
    for (std::size_t i = 0; i < lengths.size(); ++i) {
      total += lengths[i];
      pieces.start("in pieces", Priority::low, [&, i] {
        for (std::int64_t done = 0; done < lengths[i]; done += piece) {
          compute(piece);
          this_process().sync();
          if (stretches.empty() || stretches.back().process != i)
            stretches.push_back({i, own_cycles() - piece, 0});
          stretches.back().end = ends[i] = own_cycles();
        }
      });
      whole.start("in one", Priority::low, [&, i] {
        compute(lengths[i]);
        this_process().sync();
        whole_ends[i] = own_cycles();
      });
    }
    lab.machine.run();
    std::string wrong;
    auto expect = [&](bool holds, const char* what) { holds || (wrong += what, wrong += '\n', 0); };
    expect(stretches.back().end == static_cast<double>(total), "total time is not conserved");
    expect(ends == whole_ends, "computing in one piece ends at another time");
    std::deque<std::size_t> queue;  // processes in the required order of running
    for (std::size_t i = 0; i < lengths.size(); ++i) queue.push_back(i);
    for (const Stretch& s : stretches) {
      const auto next = queue.front();
      queue.pop_front();
      expect(s.process == next, "out of turn");
      if (s.end == ends[s.process]) continue;  // the process has ended
      queue.push_back(s.process);
      expect(s.end - s.begin >= period, "gave way before one period");
      expect(s.end - s.begin <= 2 * period, "did not give way after two periods");
    }
    if (lengths.size() == 1) expect(whole.use().dispatches == 1, "a lone process was sliced");
    return wrong;
  });
}

TEST(TimeSlices, GiveWayAfterOneToTwoPeriodsInTurn) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    EXPECT_EQ(check_slices(seed), "");
  }
}

// A low-priority process computes, alone at first. Then a second low-priority process becomes
// ready, by a timer or a link. This second process must wait for at most two slice periods.
TEST(TimeSlices, WokenLowProcessWaitsForAtMostTwoPeriods) {
  const Model model = make_exact_model();
  const auto found = isolated_numbers([] {
    Lab lab;
    Processor &by_timer = lab.cpu(), &by_link = lab.cpu();
    Processor& writer = lab.neighbour(by_link);
    auto& channel = lab.hard(writer, by_link);
    Numbers times(4);
    writer.start("writer", Priority::low, [&] { compute(10'000), out(channel, {4}); });
    by_link.start("reader", Priority::low, [&] { channel.in(), times[0] = own_cycles(); });
    by_timer.start("timer", Priority::low,
                   [&] { wait_until_cycle(10'240), times[1] = own_cycles(); });
    for (Processor* cpu : {&by_timer, &by_link})
      cpu->start("busy", Priority::low, [] { compute(200'000), this_process().sync(); });
    lab.machine.run();
    return Numbers{times[0] - 10'000, times[1] - 10'240, lab.busy_cycles(by_link),
                   lab.busy_cycles(by_timer)};
  });
  const auto period = model.scheduler.slice.value;
  EXPECT_LE(found.at(0), 2 * period + 200);
  EXPECT_LE(found.at(1), 2 * period);
  EXPECT_EQ(found.at(2), 200'000 + model.channel.blocked.value);
  EXPECT_EQ(found.at(3), 200'000 + model.timer.wait_future.value);
}

// Several low-priority processes run while high-priority ones interrupt them at random. The total
// time must be that of all computations plus the context switches.
TEST(TimeSlices, AndPreemptionsTogetherConserveTime) {
  const Model model = make_exact_model();
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    Load load = make_load(seed);
    std::mt19937_64 random(seed + 1000);
    const auto others = 1 + random() % 3;
    const auto found = isolated_numbers([&] {
      Lab lab;
      Recorded recorded;
      Processor& cpu = lab.cpu();
      start_load(lab, cpu, load, recorded);
      for (auto i = others; i > 0; --i)
        cpu.start("low", Priority::low, [&] { compute(load.low), this_process().sync(); });
      lab.machine.run();
      const auto use = cpu.use();
      const double clock = model.cpu.clock.value;
      return Numbers{use.busy_low.value * clock, use.busy_high.value * clock,
                     static_cast<double>(use.preemptions)};
    });
    auto high = static_cast<double>(model.timer.wait_future.value) *
                static_cast<double>(load.bursts.size());
    for (const Burst& burst : load.bursts) high += static_cast<double>(burst.cycles);
    EXPECT_EQ(found.at(0), static_cast<double>(load.low) * static_cast<double>(others + 1));
    const auto there = static_cast<double>(model.scheduler.preemption.value);
    const auto back = static_cast<double>(model.scheduler.return_to_low.value);
    EXPECT_GE(found.at(1), high + found.at(2) * there);
    EXPECT_LE(found.at(1), high + found.at(2) * (there + back));
  }
}

// A slice ends while a high-priority process has the CPU.
TEST(TimeSlices, EndDuringAPreemption) {
  const Model model = make_exact_model();
  const auto period = model.scheduler.slice.value;
  const auto found = isolated_numbers([&] {
    Lab lab;
    Processor& cpu = lab.cpu();
    cpu.start("high", Priority::high, [&] {
      wait_until_cycle(2 * period - 160);
      compute(1000);
    });
    for (int i = 0; i < 2; ++i)
      cpu.start("low", Priority::low, [&] { compute(3 * period), this_process().sync(); });
    lab.machine.run();
    return Numbers{lab.cycles()};
  });
  EXPECT_EQ(found.at(0), 2 * 3 * period + 1000 +
                             (model.timer.wait_future + model.scheduler.preemption +
                              model.scheduler.return_to_low)
                                 .value);
}

// Dates in seconds at which processes got the CPU.
struct Turns : machine::Observer {
  void name_process(const Processor&, std::uint32_t, const std::string&) override {}
  void ran(const Processor&, std::uint32_t, Doing, machine::Seconds from,
           machine::Seconds) override {
    begins.push_back(from.value);
  }
  void moved(const machine::LinkDirection&, const std::string&, std::uint64_t, machine::Seconds,
             machine::Seconds) override {}
  Numbers begins;
};

// Long computations on the real machine. Each turn on the CPU must last exactly two periods,
// because it begins on a tick. No late tick may be lost to rounding.
TEST(TimeSlices, TurnsOfTheRealMachineAreTwoPeriods) {
  const Model model = machine::load_model("t805-25");
  const double period = 5120 / 5e6;
  const auto found = isolated_numbers([&] {
    Lab lab(model);
    Turns turns;
    Processor& cpu = lab.cpu();
    for (int i = 0; i < 2; ++i)
      cpu.start("busy", Priority::low, [] { compute(25'600'000), this_process().sync(); });
    lab.machine.set_observer(&turns);
    lab.machine.run();
    return turns.begins;
  });
  ASSERT_GE(found.size(), 1000u);
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i], 2 * period * static_cast<double>(i), 1e-9) << "turn " << i;
}

// A low-priority process that is alone continues. If another one becomes ready after more than two
// periods, the first must yield at the next tick, but never within its first period.
TEST(TimeSlices, LateComerWaitsForTheNextTick) {
  const Model model = make_exact_model();
  const auto period = model.scheduler.slice.value;
  for (std::int64_t comes :
       {100, 4000, 4096 + 112, 2 * 4096 - 16, 2 * 4096 + 16, 3 * 4096 + 112, 7 * 4096 + 2000}) {
    const auto found = isolated_numbers([&] {
      Lab lab;
      Processor& cpu = lab.cpu();
      Processor& other = lab.neighbour(cpu);
      auto& channel = lab.hard(other, cpu);
      double begins = 0;
      // The process "late" first waits for its message. The process "busy" then begins, after the
      // 20 cycles of this input.
      cpu.start("late", Priority::low, [&] { channel.in(), begins = own_cycles(); });
      cpu.start("busy", Priority::low, [&] { compute(20 * period), this_process().sync(); });
      other.start("writer", Priority::high, [&] {
        compute(comes - model.channel.blocked.value);
        out(channel, {1});  // takes 16 cycles
      });
      lab.machine.run();
      return Numbers{begins};
    });
    const auto ready = comes + 16, next = (ready + period - 1) / period * period;
    EXPECT_NEAR(found.at(0), static_cast<double>(std::max(2 * period, next)), 1e-3) << comes;
  }
}

// While a high-priority process runs, a tick passes and another low-priority process becomes ready.
// The interrupted low-priority process must yield as soon as it resumes.
TEST(TimeSlices, TickThatPassesDuringAPreemptionCounts) {
  const Model model = make_exact_model();
  const auto period = model.scheduler.slice.value;
  const auto& s = model.scheduler;
  const auto found = isolated_numbers([&] {
    Lab lab;
    Processor& cpu = lab.cpu();
    auto& channel = lab.soft();
    double begins = 0;
    cpu.start("late", Priority::low, [&] { channel.in(), begins = own_cycles(); });
    cpu.start("busy", Priority::low, [&] { compute(20 * period), this_process().sync(); });
    cpu.start("high", Priority::high, [&] {
      wait_until_cycle(5 * period - 160);
      out(channel, {4});
      compute(1000), this_process().sync();  // computes until after the tick
      compute(1000);
    });
    lab.machine.run();
    return Numbers{begins};
  });
  EXPECT_EQ(found.at(0), 5 * period - 160 + s.preemption.value + soft_cost(model, 4) + 2000 +
                             s.return_to_low.value);
}

// Three low-priority processes and a high-priority one. The first low-priority process computes.
// The high-priority process makes the second ready. If it first lets its charged cycles pass
// (`pays`), this happens at once, otherwise at a date ahead of the clock. Shortly before the tick,
// the third becomes ready; or, if `has_message`, a message comes whose DMA delays the work charged
// in advance. Returns the cycles at which the second and the third process end.
Numbers end_around_tick(std::int64_t wakes, bool has_message, bool pays) {
  return isolated_numbers([&] {
    Model model = make_exact_model();
    if (has_message) model.memory.steal_word = 32;
    Lab lab(model);
    Processor& cpu = lab.cpu();
    Processor& other = lab.neighbour(cpu);
    auto &wakes_second = lab.soft(), &never = lab.soft(), &link = lab.hard(other, cpu);
    double second = 0, third = 0;
    if (has_message) {
      cpu.start("reader", Priority::high, [&] { link.in(); });
      other.start("writer", Priority::high, [&] {
        wait_until_cycle(12064);
        out(link, {200});
      });
    } else {
      cpu.start("third", Priority::low, [&] {
        occam::wait_until(12);
        compute(100), this_process().sync();
        third = own_cycles();
      });
    }
    cpu.start("high", Priority::high, [&] {
      wait_until_cycle(wakes);
      compute(200);
      if (pays) this_process().sync();
      out(wakes_second, {4});
      compute(50);
      if (pays) this_process().sync();
      never.in();
    });
    cpu.start("second", Priority::low, [&] {
      wakes_second.in();
      compute(100), this_process().sync();
      second = own_cycles();
      out(never, {4});
    });
    cpu.start("first", Priority::low, [&] { compute(30000), this_process().sync(); });
    lab.machine.run();
    return Numbers{second, third};
  });
}

TEST(TimeSlices, DoNotDependOnWhenAHighProcessPays) {
  for (const bool has_message : {false, true})
    for (std::int64_t wakes = 11904; wakes < 12288; wakes += 16) {
      const auto ahead = end_around_tick(wakes, has_message, false);
      const auto paid = end_around_tick(wakes, has_message, true);
      for (std::size_t i = 0; i < 2; ++i)
        EXPECT_NEAR(ahead.at(i), paid.at(i), 1e-3)
            << "wakes at " << wakes << (has_message ? ", a message" : ", a third process");
    }
}

}  // namespace
}  // namespace occam

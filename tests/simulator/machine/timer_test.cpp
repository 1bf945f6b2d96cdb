// Timers: their ticks of 1 us and 64 us, waits for a tick, and ALTs with a timeout.
#include <gtest/gtest.h>

#include <limits>

#include "tests/support/lab.hpp"

namespace occam {
namespace {

// On the real model, a tick is 1 us at high and 64 us at low priority; a microsecond has 25 cycles.
TEST(Timer, CountsWholeTicksOfItsPriority) {
  const Model model = machine::load_model("t805-25");
  const std::int64_t cycles_a_us = 25;
  for (auto priority : BOTH_PRIORITIES) {
    const std::int64_t tick = priority == Priority::high ? 1 : 64;
    // Reads the clock just before, at, and just after each of the first 3000 ticks.
    const auto wrong = isolated([&] {
      Lab lab(model);
      std::string text;
      lab.cpu().start("reader", priority, [&] {
        std::int64_t now = 0;
        auto read_at = [&](std::int64_t cycle) {
          compute(cycle - now - model.timer.read.value);
          now = cycle;
          const auto found = read_timer(), expected = cycle / (cycles_a_us * tick);
          if (found != expected && text.empty())
            text = fmt::format("first wrong: {} at cycle {}", found, cycle);
        };
        for (std::int64_t i = 1; i < 3000; ++i)
          for (std::int64_t d : {-5, 0, 5}) read_at(i * tick * cycles_a_us + d);
      });
      lab.machine.run();
      return text;
    });
    EXPECT_EQ(wrong, "") << "tick of " << tick << " us";
  }
}

TEST(Timer, WaitsUntilATickAndNotForThePast) {
  const Model model = make_exact_model();
  for (auto priority : BOTH_PRIORITIES) {
    const auto tick = priority == Priority::high ? 16 : 1024;
    const auto found = isolated_numbers([&] {
      Lab lab;
      Numbers times;
      auto& cpu = lab.cpu();
      cpu.start("waiter", priority, [&] {
        auto wait = [&](std::int64_t at) {
          wait_until(at);
          times.push_back(own_cycles());
        };
        for (std::int64_t at : {100, 100, 7, 101}) wait(at);
        compute(3);
        wait(100);
        times.push_back(static_cast<double>(ticks({own_cycles() / model.cpu.clock.value})));
      });
      lab.machine.run();
      times.push_back(lab.busy_cycles(cpu));
      return times;
    });
    const auto past = model.timer.wait_past.value, future = model.timer.wait_future.value;
    const auto next = std::max<std::int64_t>(101 * tick, 100 * tick + 2 * past + future);
    EXPECT_EQ(found, (Numbers{100.0 * tick, 100.0 * tick + past, 100.0 * tick + 2 * past,
                              static_cast<double>(next), static_cast<double>(next + 3 + past),
                              std::round(static_cast<double>(next + 3 + past) / tick),
                              static_cast<double>(2 * future + 3 + 3 * past)}));
  }
}

// An ALT with a channel and a timeout. A process on another processor outputs to the channel at
// some cycle, or never.
struct Timeout {
  Priority priority;
  std::int64_t starts, output_at,
      tick;  // in ticks of the reader's clock; the other two in cycles
  bool timer_first;
};

constexpr std::int64_t NEVER = -1;
constexpr std::uint64_t BYTES = 8;

std::int64_t tick_cycles(const Model& model, Priority priority) {
  const double tick = priority == Priority::high ? model.timer.high_tick : model.timer.low_tick;
  return std::llround(tick * model.cpu.clock.value);
}

// The expected cycle at which the ALT and its input end, and whether the channel is chosen.
std::pair<double, bool> expect_timeout(const Model& model, const Timeout& c) {
  const auto& alt = model.alternative;
  const auto date = c.tick * tick_cycles(model, c.priority);
  const auto comes = c.output_at == NEVER ? std::numeric_limits<std::int64_t>::max() : c.output_at;
  auto at = c.starts + alt.timer_setup.value;
  const auto enable_channel = [&] {
    at += (comes <= at ? alt.enable_ready : alt.enable_not).value;
  };
  if (!c.timer_first) enable_channel();
  at += alt.enable_timer.value;
  if (c.timer_first) enable_channel();
  const bool ready = comes <= at || date <= at;
  at += (ready ? alt.timer_wait_ready : alt.timer_wait_not).value;
  at = std::max(at, std::min(comes, date));
  const auto first = at + (c.timer_first ? alt.disable_timer : alt.disable).value;
  const bool channel = c.timer_first ? date > first : comes <= first;
  at += (alt.disable_timer + alt.disable + alt.end).value;
  if (!channel) return {static_cast<double>(at), false};
  at += cost_first(model, Side::reader, BYTES);
  return {static_cast<double>(at) +
              static_cast<double>(BYTES) / model.link.one_way_rate * model.cpu.clock.value,
          true};
}

// Runs the cases. Returns two numbers for each case: the cycle at which it ends, and whether the
// channel was chosen. If the channel was not chosen, its message is taken later.
Numbers run_timeouts(const Model& model, const std::vector<Timeout>& cases) {
  return isolated_numbers([&] {
    Lab lab(model);
    Numbers found(2 * cases.size());
    for (std::size_t i = 0; i < cases.size(); ++i) {
      Processor& here = lab.cpu();
      Processor& there = lab.neighbour(here);
      auto& channel = lab.hard(there, here);
      here.start("reader", cases[i].priority, [&, i] {
        const Timeout& c = cases[i];
        compute(c.starts);
        Words got;
        const auto note = [&](double taken) {
          found[2 * i] = own_cycles();
          found[2 * i + 1] = taken;
        };
        auto input = when(channel, got, [&] { note(1); });
        auto timeout = after(c.tick, [&] { note(0); });
        c.timer_first ? pri_alt(timeout, input) : pri_alt(input, timeout);
        if (found[2 * i + 1] == 0 && c.output_at != NEVER) channel.in();
      });
      if (cases[i].output_at != NEVER)
        there.start("writer", Priority::high, [&, i] {
          compute(cases[i].output_at - cost_first(model, Side::writer, BYTES));
          out(channel, {BYTES});
        });
    }
    lab.machine.run();
    return found;
  });
}

void expect_timeouts(const Model& model, const std::vector<Timeout>& cases) {
  const auto found = run_timeouts(model, cases);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Timeout& c = cases[i];
    const auto [end, channel] = expect_timeout(model, c);
    EXPECT_NEAR(found.at(2 * i), end, ROUNDING) << fmt::format(
        "{} priority, starts at {}, output at {}, tick {}, {} first", name_of(c.priority), c.starts,
        c.output_at, c.tick, c.timer_first ? "timer" : "channel");
    EXPECT_EQ(found.at(2 * i + 1), channel ? 1 : 0);
  }
}

TEST(Timeout, FiresOrNotAtTheSumOfItsRows) {
  for (const Model& model :
       {make_complete_model(), make_on_chip_model(), machine::load_model("t805-25")}) {
    std::vector<Timeout> cases;
    for (auto priority : BOTH_PRIORITIES)
      for (bool timer_first : {false, true})
        for (std::int64_t starts : {7, 5000})
          for (std::int64_t output_at : {NEVER, std::int64_t{2001}, std::int64_t{9001}})
            for (std::int64_t date : {0, 3200, 12'800})
              cases.push_back(
                  {priority, starts, output_at, date / tick_cycles(model, priority), timer_first});
    expect_timeouts(model, cases);
  }
}

// The timeout falls on any cycle of the ALT: it has passed before, or it passes while guards are
// enabled, during taltwt, or later.
TEST(Timeout, MayComeAtAnyCycleOfTheAlt) {
  const Model model = make_complete_model();
  std::vector<Timeout> cases;
  for (auto priority : BOTH_PRIORITIES)
    for (bool timer_first : {false, true})
      for (std::int64_t before = -10; before < 120; ++before)
        cases.push_back(
            {priority, 4096 - before, NEVER, 4096 / tick_cycles(model, priority), timer_first});
  expect_timeouts(model, cases);
}

// The timer wakes the ALT, and the output comes while guards are disabled. The channel must be
// chosen if the output is there when the channel's guard is disabled and no earlier guard was
// ready. (If both fall on the same cycle, either may be chosen.)
TEST(Timeout, GuardIsTakenThatIsReadyAtItsOwnTurn) {
  const Model model = make_complete_model();
  const auto date = 4096, turn = date + static_cast<int>(model.alternative.disable.value);
  std::vector<Timeout> cases;
  for (auto priority : BOTH_PRIORITIES)
    for (bool timer_first : {false, true})
      for (std::int64_t output_at = date - 30; output_at < date + 60; ++output_at)
        if (output_at != date && output_at != turn)
          cases.push_back(
              {priority, 100, output_at, date / tick_cycles(model, priority), timer_first});
  expect_timeouts(model, cases);
}

// A timeout that does not fire must not prolong the run, which ends with its processes.
TEST(Timeout, ThatDoesNotFireDoesNotProlongTheRun) {
  for (auto priority : BOTH_PRIORITIES) {
    const auto found = isolated_numbers([&] {
      Lab lab;
      double end = 0;
      Processor& here = lab.cpu();
      Processor& there = lab.neighbour(here);
      auto& channel = lab.hard(there, here);
      here.start("reader", priority, [&] {
        for (int i = 0; i < 3; ++i) {
          Words got;
          pri_alt(after(1'000'000, [] {}), when(channel, got, [] {}));
        }
        end = own_cycles();
      });
      there.start("writer", Priority::low, [&] {
        for (int i = 0; i < 3; ++i) out(channel, {BYTES});
      });
      lab.machine.run();
      return Numbers{end - lab.cycles()};
    });
    EXPECT_NEAR(found.at(0), 0, ROUNDING);
  }
}

TEST(Timer, WakesAtTheTickAndReadsIt) {
  for (auto priority : BOTH_PRIORITIES) {
    const double us = priority == Priority::high ? 1 : 64;
    const auto found = isolated_numbers([&] {
      Lab lab(machine::override_model("t805-25", {{"instruction.fetch", 0.0}}, "tests"));
      Numbers seen;
      lab.cpu().start("waiter", priority, [&] {
        for (std::int64_t tick : {10, 20, 21, 1000}) {
          // A date in the past: costs 7 cycles and never waits for a tick.
          if (tick == 21) wait_until(0);
          wait_until(tick);
          seen.push_back(this_process().now().value * 1e6);
          seen.push_back(static_cast<double>(read_timer()));
        }
      });
      lab.machine.run();
      return seen;
    });
    // The wait for the past date begins 3 cycles after tick 20 and takes 7 cycles. The wait for
    // tick 21 then takes 33 cycles. At high priority a tick is 25 cycles, so tick 21 has passed by
    // then and the clock is not read again.
    const double third = us == 1 ? 20 + (3 + 7 + 33) / 25.0 : 21 * us;
    const double dates[] = {10 * us, 20 * us, third, 1000 * us}, reads[] = {10, 20, 21, 1000};
    for (std::size_t i = 0; i < std::size(dates); ++i) {
      EXPECT_NEAR(found.at(2 * i), dates[i], 1e-6);
      EXPECT_EQ(found.at(2 * i + 1), reads[i]);
    }
  }
}

}  // namespace
}  // namespace occam

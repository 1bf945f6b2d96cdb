// The two-priority scheduler, compared with a small independent calculation. Each seed has a
// processor of its own in one machine.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/simulator/machine/bursts.hpp"

namespace occam {
namespace {

constexpr int SEEDS = 100;

struct Outcome {
  std::int64_t low_end = 0, busy_high = 0, busy_low = 0, preemptions = 0;
  std::vector<std::int64_t> burst_ends;
};

// Calculates the expected outcome. The process of each burst (a high-priority computation) first
// waits for the burst's date. If the low-priority process is then running, the burst pre-empts it.
// The switch back to the low-priority process takes time, and another burst may cut it short.
Outcome predict(const Model& model, const Load& load) {
  const auto wait = model.timer.wait_future.value * static_cast<std::int64_t>(load.bursts.size());
  const auto there = model.scheduler.preemption.value, back = model.scheduler.return_to_low.value;
  Outcome o{0, wait, load.low, 0, {}};
  std::int64_t free = wait, low_from = wait, left = load.low;
  for (const Burst& burst : load.bursts) {
    auto start = std::max(burst.date, free);
    if (burst.date >= free && left > 0) {
      o.busy_high += std::min(burst.date, low_from) - free;
      const auto ran = std::max<std::int64_t>(0, burst.date - low_from);
      if (left <= ran) o.low_end = low_from + left;
      left -= std::min(left, ran);
      if (left > 0) {
        ++o.preemptions;
        o.busy_high += there;
        start += there;
      }
    }
    o.busy_high += burst.cycles;
    o.burst_ends.push_back(free = start + burst.cycles);
    low_from = left > 0 ? free + back : free;
  }
  if (left > 0) {
    o.low_end = low_from + left;
    o.busy_high += low_from - free;
  }
  return o;
}

TEST(Scheduler, LowProcessIsLateByTheTimeStolenAndTheSwitches) {
  const Model model = make_exact_model();
  std::vector<Load> loads;
  for (int seed = 0; seed < SEEDS; ++seed) loads.push_back(make_load(seed));
  const auto found = isolated_numbers([&] {
    Lab lab;
    std::deque<Recorded> recorded(loads.size());
    for (int seed = 0; seed < SEEDS; ++seed)
      start_load(lab, lab.cpu(), loads[seed], recorded[seed]);
    lab.machine.run();
    Numbers all;
    for (int seed = 0; seed < SEEDS; ++seed) {
      const auto use = lab.machine.processors()[2 * seed]->use();
      const double clock = model.cpu.clock.value;
      all.insert(all.end(), {recorded[seed].low_end, use.busy_high.value * clock,
                             use.busy_low.value * clock, static_cast<double>(use.preemptions)});
      const auto& ends = recorded[seed].burst_ends;
      all.insert(all.end(), ends.begin(), ends.end());
    }
    return all;
  });
  std::size_t at = 0;
  for (int seed = 0; seed < SEEDS; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    const Outcome expected = predict(model, loads[seed]);
    EXPECT_EQ(found.at(at++), expected.low_end);
    EXPECT_EQ(found.at(at++), expected.busy_high);
    EXPECT_EQ(found.at(at++), expected.busy_low);
    EXPECT_EQ(found.at(at++), expected.preemptions);
    for (auto end : expected.burst_ends) EXPECT_EQ(found.at(at++), end);
  }
  EXPECT_EQ(at, found.size());
}

TEST(Engine, EventsHappenByDateThenInTheOrderAskedFor) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    std::mt19937_64 random(seed);
    std::vector<std::pair<double, double>> asked;  // date and number of each request
    for (int i = 0; i < 200; ++i) asked.emplace_back(static_cast<double>(random() % 20), i);
    const auto found = isolated_numbers([&] {
      Lab lab;
      auto& engine = lab.cpu().engine();
      Numbers order;
      for (auto [date, i] : asked) engine.at({date}, [&order, i] { order.push_back(i); });
      lab.machine.run();
      return order;
    });
    std::ranges::stable_sort(asked, {}, &std::pair<double, double>::first);
    Numbers expected;
    for (auto [date, i] : asked) expected.push_back(i);
    EXPECT_EQ(found, expected);
  }
}

// Between any two moments, the busy time of a processor must neither decrease nor grow by more than
// the elapsed time.
TEST(Scheduler, UseNeverRunsBackwardsNorAheadOfTheClock) {
  for (int seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    EXPECT_EQ(isolated([&]() -> std::string {
                const Load load = make_load(seed);
                Lab lab;
                Recorded recorded;
                Processor& cpu = lab.cpu();
                start_load(lab, cpu, load, recorded);
                std::string wrong;
                double last = 0, since = 0;
                const auto sample = [&] {
                  const double busy = lab.busy_cycles(cpu), now = lab.cycles();
                  if (busy < last || busy - last > now - since)
                    wrong += fmt::format("{} busy of {} at {}\n", busy - last, now - since, now);
                  last = busy;
                  since = now;
                };
                for (std::int64_t date = 0; date < 60'000; date += 3)
                  cpu.engine().at(Cycles{date} / cpu.clock(), [&sample] { sample(); });
                lab.machine.run();
                return wrong;
              }),
              "");
  }
}

// A process must end when all cycles that its body was charged have passed.
TEST(Scheduler, ProcessEndsWhenItsTimeHasPassed) {
  for (auto priority : BOTH_PRIORITIES) {
    const auto found = isolated_numbers([&] {
      Lab lab;
      Processor& cpu = lab.cpu();
      cpu.start("last", priority, [] { compute(1000); });
      lab.machine.run();
      return Numbers{lab.cycles(), lab.busy_cycles(cpu)};
    });
    EXPECT_EQ(found, (Numbers{1000, 1000}));
  }
}

// High-priority processes must run in the order of the dates at which they became ready. A process
// that has charged cycles in advance may make another one ready at a date ahead of the clock. A
// process made ready by a link before that date must run first.
TEST(Scheduler, ReadyQueuesAreFirstComeFirstServedBySimulatedTime) {
  const auto found = isolated_numbers([] {
    Lab lab;
    Processor& a = lab.cpu();
    Processor& b = lab.neighbour(a);
    auto &soft = lab.soft(), &hard = lab.hard(b, a);
    Numbers ends(3);
    const auto finish = [&ends](int i) {
      compute(100);
      ends[i] = own_cycles();
      this_process().sync();
    };
    a.start("by soft channel", Priority::high, [&] { soft.in(), finish(0); });
    a.start("by link", Priority::high, [&] { hard.in(), finish(1); });
    a.start("ahead of the clock", Priority::high, [&] {
      compute(5000);
      out(soft, Words{});
      compute(5000);
      finish(2);
    });
    b.start("writer", Priority::high, [&] { out(hard, Words{100}); });
    lab.machine.run();
    return ends;
  });
  const Model model = make_exact_model();
  const auto last = 2 * model.channel.blocked.value + 5000 + soft_cost(model, 4) + 5000 + 100;
  EXPECT_EQ(found.at(2), last);
  EXPECT_EQ(found.at(1), last + 100);
  EXPECT_EQ(found.at(0), last + 200);
}

}  // namespace
}  // namespace occam

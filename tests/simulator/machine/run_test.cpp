// How a run ends: all processes have ended, the limit is reached, or the user interrupts it.
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <thread>

#include "tests/simulator/machine/failures.hpp"

namespace occam {
namespace {

using machine::End;
using machine::Seconds;

Seconds date_of_cycle(const Lab& lab, std::int64_t cycle) {
  return Cycles{cycle} / lab.machine.model().cpu.clock;
}

// Starts two processes on two processors that compute and exchange messages for ever.
void start_endless(Lab& lab) {
  Processor& a = lab.cpu();
  Processor& b = lab.neighbour(a);
  auto &there = lab.hard(a, b), &back = lab.hard(b, a);
  a.start("ping", Priority::high, [&] {
    for (;;) out(there, {100}), back.in(), compute(300);
  });
  b.start("pong", Priority::low, [&] {
    for (;;) there.in(), out(back, {60}), compute(77);
  });
  for (int i = 0; i < 2; ++i)
    b.start("busy", Priority::low, [] {
      for (;;) compute(10'000), this_process().sync();
    });
}

TEST(Run, EndsAtItsLimitWithNothingBeyond) {
  for (std::int64_t limit : {1, 20, 21, 1000, 4096, 12'345, 100'000}) {
    SCOPED_TRACE(fmt::format("limit {}", limit));
    const auto found = isolated_numbers([&] {
      Lab lab;
      start_endless(lab);
      const End end = lab.machine.run(date_of_cycle(lab, limit));
      Numbers all{static_cast<double>(end == End::limit), lab.cycles()};
      for (const auto& cpu : lab.machine.processors()) all.push_back(lab.busy_cycles(*cpu));
      for (const auto& link : lab.machine.links())
        all.push_back(link->use().busy.value * lab.machine.model().cpu.clock.value);
      return all;
    });
    EXPECT_EQ(found.at(0), 1);
    EXPECT_EQ(found.at(1), limit);
    for (std::size_t i = 2; i < found.size(); ++i) {
      EXPECT_GE(found[i], 0);
      EXPECT_LE(found[i], static_cast<double>(limit) * (1 + 1e-12));
    }
    EXPECT_EQ(found.at(3), limit);  // the second processor always has work
  }
}

// A process that charges cycles in advance has an own time ahead of the machine's clock. The
// process blocks when its own time is past the limit. The run must end at its limit, for any kind
// of wait and any number of parts.
TEST(Run, EndsAtItsLimitThoughAProcessWaitsFromALaterTimeOn) {
  constexpr std::int64_t LIMIT = 100;  // limit of the run in cycles
  using Waits = void (*)(Channel<Words>&);
  const std::pair<const char*, Waits> all[] = {
      {"out", [](Channel<Words>& channel) { out(channel, {}); }},
      {"in", [](Channel<Words>& channel) { channel.in(); }},
      {"alt", [](Channel<Words>& channel) {
         Words message;
         pri_alt(when(channel, message, [] {}));
       }}};
  for (const auto& engine :
       {engine_under_test(),
        machine::EngineParams{.links = machine::Links::direct, .parts = {0, 1}}})
    for (const auto& [name, waits] : all)
      for (const bool hard : {false, true})
        for (const auto priority : BOTH_PRIORITIES) {
          const auto found = isolated_numbers([&] {
            Lab lab(make_exact_model(), machine::Code::bare, engine);
            Processor &a = lab.cpu(), &b = lab.neighbour(a);
            auto& channel = !hard                    ? lab.soft()
                            : waits == all[0].second ? lab.hard(a, b)
                                                     : lab.hard(b, a);
            a.start("waits", priority, [&] {
              compute(5 * LIMIT);
              waits(channel);
            });
            const End end = lab.machine.run(date_of_cycle(lab, LIMIT));
            return Numbers{static_cast<double>(end == End::limit), lab.cycles()};
          });
          EXPECT_EQ(found, (Numbers{1, static_cast<double>(LIMIT)}))
              << name << (hard ? " on a link, " : ", ") << name_of(priority);
        }
}

// Starts a process that computes for ever. It never blocks, and never waits until its charged
// cycles have passed.
void start_computing(Processor& cpu, Priority priority, std::int64_t step) {
  cpu.start("busy", priority, [step] {
    for (;;) compute(step);
  });
}

TEST(Run, EndsAtItsLimitThoughAProcessOnlyComputes) {
  for (const auto priority : BOTH_PRIORITIES)
    for (const std::int64_t step : {1, 1000, 1 << 30})
      for (const std::int64_t limit : {1000, 5'000'000}) {
        const auto found = isolated_numbers([&] {
          Lab lab;
          auto& cpu = lab.cpu();
          start_computing(cpu, priority, step);
          const End end = lab.machine.run(date_of_cycle(lab, limit));
          return Numbers{static_cast<double>(end == End::limit), lab.cycles(),
                         lab.busy_cycles(cpu)};
        });
        const auto cycles = static_cast<double>(limit);
        EXPECT_EQ(found, (Numbers{1, cycles, cycles})) << "step " << step;
      }
}

TEST(Run, WithoutALimitEndsThoughAProcessOnlyComputes) {
  const auto found = isolated_numbers([] {
    Lab lab;
    Processor& cpu = lab.cpu();
    start_computing(cpu, Priority::low, 1000);
    lab.machine.stop_processor(cpu, date_of_cycle(lab, 12'345));
    const End end = lab.machine.run();
    return Numbers{static_cast<double>(end == End::done), lab.cycles(), lab.busy_cycles(cpu)};
  });
  EXPECT_EQ(found, (Numbers{1, 12'345, 12'345}));
}

// Observes the same run up to a limit and beyond it. Events up to the limit must be the same.
TEST(Run, LimitDoesNotChangeWhatHappensBefore) {
  const auto seen = [](std::int64_t limit, std::int64_t until) {
    return isolated([&] {
      Lab lab;
      std::string log;
      start_endless(lab);
      lab.cpu().start("clock", Priority::high, [&] {
        for (std::int64_t at = 64; at <= until; at += 64) {
          wait_until_cycle(at);
          for (const auto& cpu : lab.machine.processors())
            log += fmt::format("{:a} ", lab.busy_cycles(*cpu));
          for (const auto& link : lab.machine.links()) log += fmt::format("{} ", link->use().bytes);
        }
      });
      lab.machine.run(date_of_cycle(lab, limit));
      return log;
    });
  };
  EXPECT_EQ(seen(50'001, 49'984), seen(200'000, 49'984));
}

TEST(Run, IsDoneBeforeItsLimit) {
  for (std::int64_t limit : {1000, 1001, 50'000}) {
    const auto found = isolated_numbers([&] {
      Lab lab;
      lab.cpu().start("short", Priority::low, [] { compute(1000); });
      const End end = lab.machine.run(date_of_cycle(lab, limit));
      return Numbers{static_cast<double>(end == End::done), lab.cycles()};
    });
    EXPECT_EQ(found, (Numbers{1, 1000})) << "limit " << limit;
  }
}

TEST(Run, StopsWhenTheUserWants) {
  const auto found = isolated_numbers([] {
    Lab lab;
    start_endless(lab);
    start_computing(lab.cpu(), Priority::high, 1000);
    Processor& cpu = lab.cpu();
    cpu.start("user", Priority::high, [] {
      wait_until_cycle(40'000);
      machine::request_stop();
    });
    const End end = lab.machine.run();
    return Numbers{static_cast<double>(end == End::interrupt), lab.cycles()};
  });
  EXPECT_EQ(found.at(0), 1);
  EXPECT_GE(found.at(1), 40'000);
  EXPECT_LE(found.at(1), 41'000);
}

// A signal must end the run even if it comes while SimGrid starts; SimGrid itself would end the
// program.
TEST(Run, BeginsWhileTheUserAsksForItsEnd) {
  test::run_isolated([] {
    static std::atomic<int> asked = 0;
    signal(SIGINT, [](int) { ++asked; });
    const auto to = pthread_self();
    const std::jthread user([to](const std::stop_token& enough) {
      for (; !enough.stop_requested(); usleep(20)) pthread_kill(to, SIGINT);
    });
    while (asked < 100) {
    }
    Lab lab;
    lab.cpu().start("once", Priority::high, [] { compute(1000); });
    EXPECT_EQ(lab.machine.run(), End::done);
  });
}

// At the end of the run, three timers remain: of a pre-empted computation, of a time slice that is
// not needed, and of a timeout that does not fire. None of them may move the clock.
TEST(Run, EndsWithItsLastProcess) {
  const Model model = make_exact_model();
  const auto found = isolated_numbers([&] {
    Lab lab;
    Processor& cpu = lab.cpu();
    auto& channel = lab.soft();
    cpu.start("timeout", Priority::high, [&] {
      Words got;
      pri_alt(after(100'000, [] {}), when(channel, got, [] {}));
    });
    cpu.start("a", Priority::low, [&] { compute(3 * model.scheduler.slice.value); });
    cpu.start("b", Priority::low, [&] { compute(100), out(channel, {}); });
    lab.machine.run();
    return Numbers{lab.cycles() - lab.busy_cycles(cpu)};
  });
  EXPECT_EQ(found.at(0), 0);
}

// When the limit ends a run, processes must be unwound and the objects that they hold destroyed.
TEST(Run, UnwindsWhatHasNotEnded) {
  const auto found = isolated_numbers([] {
    double released = 0;
    struct Holder {
      double& count;
      ~Holder() { count += 1; }
    };
    {
      Lab lab;
      Processor& cpu = lab.cpu();
      auto& channel = lab.soft();
      for (auto priority : BOTH_PRIORITIES)
        cpu.start("holder", priority, [&, priority] {
          Holder holder{released};
          if (priority == Priority::high) channel.in();
          par({{"branch", Priority::low,
                [&] {
                  Holder inner{released};
                  compute(1 << 30), this_process().sync();
                }},
               {"own", Priority::low, [&] { compute(1 << 30), this_process().sync(); }}});
        });
      lab.machine.run(date_of_cycle(lab, 100'000));
    }
    return Numbers{released};
  });
  EXPECT_EQ(found.at(0), 3);
}

}  // namespace
}  // namespace occam

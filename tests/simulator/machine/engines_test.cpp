// Links by SimGrid or by rules of our own, processes on fibers or on SimGrid's actors: all the
// same.
#include <gtest/gtest.h>

#include "simulator/machine/faults.hpp"
#include "tests/simulator/machine/random_machine.hpp"

namespace occam {
namespace {

using machine::EngineParams;
using machine::Links;
using machine::Processes;

constexpr EngineParams FIBERS, ACTORS{.processes = Processes::actors},
    DIRECT{.links = Links::direct};
constexpr EngineParams ALL_KINDS[] = {FIBERS, ACTORS, DIRECT};

struct Engines : testing::Test {
  void SetUp() override {
    if (test::IS_SANITIZED) GTEST_SKIP();
  }
};

// A random machine, some of whose links are cut: when messages came, how it ended, what was busy.
std::string run_random(std::uint64_t seed, EngineParams engine) {
  return isolated([&] {
    const Plan plan = make_plan(seed);
    Lab lab(make_stealing_model(), machine::Code::bare, engine);
    std::string log, wrong;
    build_machine(lab, plan);
    for (const Stream& stream : plan.streams) start_stream(lab, stream, log, wrong);
    const auto& cpus = lab.machine.processors();
    const auto& links = plan.topology.links;
    if (seed % 3 == 0)
      lab.machine.cut_link(*cpus[links[0].a.processor], *cpus[links[0].b.processor], {1e-3});
    try {
      lab.machine.run();
    } catch (const machine::Deadlock& deadlock) {
      log += deadlock.what();
    }
    for (const auto& cpu : cpus)
      log += fmt::format(" {:a} {}", lab.busy_cycles(*cpu), cpu->use().preemptions);
    for (const auto& link : lab.machine.links())
      log += fmt::format(" {:a}", link->use().busy.value);
    return fmt::format("{} at {:a}, {} events {}", log, lab.cycles(), lab.machine.events(), wrong);
  });
}

TEST_F(Engines, RunRandomMachinesTheSame) {
  int deadlocks = 0;
  for (std::uint64_t seed = 0; seed < 42; ++seed) {
    const auto on_fibers = run_random(seed, FIBERS);
    EXPECT_EQ(on_fibers, run_random(seed, ACTORS)) << "seed " << seed;
    EXPECT_EQ(on_fibers, run_random(seed, DIRECT)) << "seed " << seed;
    deadlocks += on_fibers.find("(link cut)") != std::string::npos ? 1 : 0;
  }
  EXPECT_GE(deadlocks, 3);
}

// One waits for ever, one computes for ever, one waits in a PAR, one has not begun: at the limit
// all are left, inside out, and of the last nothing but what its body holds.
TEST_F(Engines, BodiesThatHaveNotEndedAreUnwound) {
  for (const auto engine : ALL_KINDS) {
    const auto log = isolated([&] {
      std::string left;
      struct Leaver {
        std::string& log;
        std::string name;
        ~Leaver() { log += name + " "; }
      };
      {
        Lab lab(make_exact_model(), machine::Code::bare, engine);
        auto& cpu = lab.cpu();
        auto& channel = lab.soft();
        cpu.start("waits", Priority::high, [&] {
          const Leaver outer{left, "outer"}, inner{left, "inner"};
          channel.in();
        });
        cpu.start("forks", Priority::high, [&] {
          const Leaver leaver{left, "par"};
          par({{"branch", Priority::high, [&] {
                  const Leaver branch{left, "branch"};
                  lab.soft().in();
                }}});
        });
        cpu.start("computes", Priority::low, [&] {
          const Leaver leaver{left, "computes"};
          for (;;) compute(1000), this_process().sync();
        });
        cpu.start("late", Priority::low,
                  [held = std::make_shared<Leaver>(left, "held")] { held->log += "begun "; });
        EXPECT_EQ(lab.machine.run({100e-6}), machine::End::limit);
        EXPECT_EQ(left, "");
      }
      return left;
    });
    EXPECT_EQ(log, "inner outer branch par computes held ");
  }
}

TEST_F(Engines, WhatABodyThrowsEndsTheRun) {
  for (const auto engine : ALL_KINDS)
    EXPECT_THROW(isolated([&]() -> std::string {
                   Lab lab(make_exact_model(), machine::Code::bare, engine);
                   auto& cpu = lab.cpu();
                   cpu.start("waits", Priority::low, [&] { lab.soft().in(); });
                   cpu.start("throws", Priority::high, [] { throw std::runtime_error("so"); });
                   lab.machine.run();
                   return "not thrown";
                 }),
                 test::ChildThrew);
}

TEST_F(Engines, HaveTheSameStacks) {
  for (const auto engine : ALL_KINDS) {
    const auto sum = isolated([&] {
      int sum = 0;
      Lab lab(make_exact_model(), machine::Code::bare, engine);
      lab.cpu().start("deep", Priority::low, [&] {
        volatile char room[100 * 1024];
        for (std::size_t i = 0; i < sizeof room; i += 1024) room[i] = 1;
        this_process().sync();
        for (std::size_t i = 0; i < sizeof room; i += 1024) sum += room[i];
      });
      lab.machine.run();
      return std::to_string(sum);
    });
    EXPECT_EQ(sum, "100");
  }
}

}  // namespace
}  // namespace occam

// All combinations of links (SimGrid's or tlab's own) and processes (fibers or SimGrid's actors)
// must give equal results.
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

// Runs a random machine. Returns dates of arrival, the end and busy times as text. For a machine in
// one part, the text also has the number of events.
std::string run_random(std::uint64_t seed, EngineParams engine, bool cuts_a_link,
                       bool is_different = false) {
  return isolated([&] {
    Plan plan = make_plan(seed);
    for (Stream& stream : plan.streams) stream.lengths.back() = 0;
    if (!cuts_a_link) let_some_poll(plan, seed);  // programs that poll never deadlock
    if (is_different) make_different(plan, seed);
    Lab lab(make_stealing_model(), machine::Code::bare, engine);
    std::vector<std::string> logs(plan.streams.size()), wrongs(plan.streams.size());
    build_machine(lab, plan);
    for (std::size_t i = 0; i < logs.size(); ++i)
      start_stream(lab, plan.streams[i], logs[i], wrongs[i]);
    const auto& cpus = lab.machine.processors();
    const auto& links = plan.topology.links;
    if (cuts_a_link)
      lab.machine.cut_link(*cpus[links[0].a.processor], *cpus[links[0].b.processor], {1e-3});
    std::string log;
    try {
      lab.machine.run();
    } catch (const machine::Deadlock& deadlock) {
      log += deadlock.what();
    }
    for (const auto& stream : logs) log += stream;
    for (const auto& cpu : cpus)
      log += fmt::format(" {:a} {}", lab.busy_cycles(*cpu), cpu->use().preemptions);
    for (const auto& link : lab.machine.links())
      log += fmt::format(" {:a}", link->use().busy.value);
    if (engine.parts.empty()) log += fmt::format(" {} events", lab.machine.events());
    return fmt::format("{} at {:a} {}", log, lab.cycles(), fmt::join(wrongs, ""));
  });
}

TEST_F(Engines, RunRandomMachinesTheSame) {
  int deadlocks = 0;
  for (std::uint64_t seed = 0; seed < 42; ++seed) {
    const auto run = [&](EngineParams engine) {
      return run_random(seed, engine, seed % 3 == 0, seed % 3 == 1);
    };
    const auto on_fibers = run(FIBERS);
    EXPECT_EQ(on_fibers, run(ACTORS)) << "seed " << seed;
    EXPECT_EQ(on_fibers, run(DIRECT)) << "seed " << seed;
    deadlocks += on_fibers.find("(link cut)") != std::string::npos ? 1 : 0;
  }
  EXPECT_GE(deadlocks, 3);
}

// Results must be the same on 2 to 16 threads, for any division into parts.
TEST_F(Engines, RunRandomMachinesTheSameInParts) {
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    EngineParams one = DIRECT;
    // a single part; stating it makes run_random() omit the number of events, which is larger with
    // several parts
    one.parts = {0};
    const std::string in_one[] = {run_random(seed, one, false), run_random(seed, one, false, true)};
    std::mt19937_64 random(seed);
    for (const int parts : {2, 3, 4, 8, 16}) {
      EngineParams engine = DIRECT;
      for (int i = 0; i < 16; ++i)
        engine.parts.push_back(i < parts ? i : static_cast<int>(random() % parts));
      std::ranges::shuffle(engine.parts, random);
      for (const bool is_different : {false, true})
        EXPECT_EQ(in_one[is_different], run_random(seed, engine, false, is_different))
            << "seed " << seed << ", " << parts << (is_different ? ", different" : "");
    }
  }
}

// The parts of a machine must run in common time windows. Without common windows, only one part
// would run at a time.
TEST_F(Engines, PartsShareWindows) {
  const Plan plan = make_plan(3);
  EngineParams engine = DIRECT;
  engine.parts = {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1};  // two halves of a mesh
  Lab lab(make_stealing_model(), machine::Code::bare, engine);
  build_machine(lab, plan);
  std::vector<std::string> logs(plan.streams.size()), wrongs(plan.streams.size());
  for (std::size_t i = 0; i < logs.size(); ++i)
    start_stream(lab, plan.streams[i], logs[i], wrongs[i]);
  lab.machine.run();
  const auto windows = lab.machine.windows();
  EXPECT_GT(windows.at_links, 0u);
  EXPECT_GT(windows.shared, windows.all / 20) << windows.all << " windows";
}

// At the time limit, one process waits for ever, one computes, one waits in a PAR, and one has not
// begun. All must be unwound: their objects must be destroyed, the innermost first. The process
// that has not begun has no objects yet; only the captured variables of its body may be destroyed.
TEST_F(Engines, BodiesThatHaveNotEndedAreUnwound) {
  for (const auto& engine : ALL_KINDS) {
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
  for (const auto& engine : ALL_KINDS)
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
  for (const auto& engine : ALL_KINDS) {
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

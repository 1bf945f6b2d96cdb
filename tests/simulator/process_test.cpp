// PAR and timers.
#include <gtest/gtest.h>

#include <random>

#include "tests/simulator/support.hpp"

namespace occam {
namespace {

// A random PAR: every process computes, then runs its branches, if any.
struct Tree {
  std::int64_t cycles;
  std::vector<Tree> branches;
};

Tree make_tree(std::mt19937_64& random, int depth) {
  Tree tree{static_cast<std::int64_t>(random() % 1000), {}};
  if (depth > 0)
    for (auto n = random() % 4; n > 0; --n) tree.branches.push_back(make_tree(random, depth - 1));
  return tree;
}

// startp for each branch, endp for each and for the parent; on one CPU nothing overlaps.
std::int64_t expected_time(const Model& model, const Tree& tree) {
  std::int64_t time = tree.cycles;
  if (tree.branches.empty()) return time;
  time += model.scheduler.end_process.value;
  for (const Tree& branch : tree.branches)
    time += (model.scheduler.start_process + model.scheduler.end_process).value +
            expected_time(model, branch);
  return time;
}

// Runs it; returns its own time at its end. A parent goes on after all its branches.
double run_tree(const Tree& tree, Priority priority, std::string& wrong) {
  compute(tree.cycles);
  double last = 0;
  auto branch = [&](std::size_t i) {
    auto body = [&, i] { last = std::max(last, run_tree(tree.branches[i], priority, wrong)); };
    return Branch{"branch", priority, body};
  };
  switch (tree.branches.size()) {
    case 1:
      par({branch(0)});
      break;
    case 2:
      par({branch(0), branch(1)});
      break;
    case 3:
      par({branch(0), branch(1), branch(2)});
      break;
    default:
      break;
  }
  this_process().sync();
  if (own_cycles() < last) wrong += fmt::format("joined at {}, before {}\n", own_cycles(), last);
  return own_cycles();
}

TEST(Par, JoinsAfterTheLastBranchAtTheSumOfAllTimes) {
  const Model model = make_exact_model();
  for (std::uint64_t seed = 0; seed < 30; ++seed)
    for (auto priority : BOTH_PRIORITIES) {
      SCOPED_TRACE(fmt::format("seed {}", seed));
      std::mt19937_64 random(seed);
      const Tree tree = make_tree(random, 4);
      const auto wrong = isolated([&] {
        Lab lab;
        std::string text;
        lab.cpu().start("root", priority, [&] {
          const double end = run_tree(tree, priority, text);
          if (const auto expected = expected_time(model, tree); end != expected)
            text += fmt::format("ended at {}, not {}\n", end, expected);
        });
        lab.machine.run();
        return text;
      });
      EXPECT_EQ(wrong, "");
    }
}

// PRI PAR: a high branch computes first whatever its place, and the parent joins both.
TEST(Par, BranchesOfBothPrioritiesJoin) {
  const auto found = isolated_numbers([] {
    Lab lab;
    Numbers ends(3);
    lab.cpu().start("parent", Priority::low, [&] {
      par({{"low", Priority::low, [&] { compute(5000), ends[0] = own_cycles(); }},
           {"high", Priority::high, [&] { compute(7000), ends[1] = own_cycles(); }}});
      par({{"high only", Priority::high, [] { compute(100); }}});  // has ended by the join
      ends[2] = own_cycles();
    });
    lab.machine.run();
    return ends;
  });
  EXPECT_LT(found.at(1), found.at(0));
  EXPECT_LT(found.at(0), found.at(2));
  const Model model = make_exact_model();
  const auto& costs = model.scheduler;
  const Cycles switches = 2 * costs.preemption + 2 * costs.return_to_low;
  EXPECT_EQ(found.at(2),
            5000 + 7000 + 100 + (3 * costs.start_process + 5 * costs.end_process + switches).value);
}

// The real model: 1 us at high priority, 64 us at low; 25 cycles a microsecond.
TEST(Timer, CountsWholeTicksOfItsPriority) {
  const Model model = machine::load_model("t805-25");
  const std::int64_t cycles_a_us = 25;
  for (auto priority : BOTH_PRIORITIES) {
    const std::int64_t tick = priority == Priority::high ? 1 : 64;
    // Just before, at and after the first 3000 ticks.
    const auto wrong = isolated([&] {
      Model plain = model;
      plain.software.occam_factor = 1;
      Lab lab(plain);
      std::string text;
      lab.cpu().start("reader", priority, [&] {
        std::int64_t now = 0;
        auto read_at = [&](std::int64_t cycle) {
          compute(cycle - now - plain.timer.read.value);
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

}  // namespace
}  // namespace occam

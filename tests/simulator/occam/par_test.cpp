// PAR: its cost, and how it waits for its branches.
#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "tests/support/lab.hpp"

namespace occam {
namespace {

// A random PAR. Each process computes, then runs its branches, if it has any.
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

// The last branch runs in the parent process. Each other branch costs its set-up, startp and endp,
// and the parent its own endp. On one CPU nothing overlaps.
std::int64_t expected_time(const Model& model, const Tree& tree) {
  const auto& costs = model.scheduler;
  std::int64_t time = tree.cycles;
  if (tree.branches.empty()) return time;
  const auto others = static_cast<std::int64_t>(tree.branches.size()) - 1;
  time += (others * (costs.par_branch + costs.start_process + costs.end_process)).value;
  time += (costs.par_setup + costs.end_process).value;
  for (const Tree& branch : tree.branches) time += expected_time(model, branch);
  return time;
}

// Runs the tree, and returns the time at its end. A parent must continue after all its branches.
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

// PRI PAR: a high-priority branch must compute first, at whatever place it stands, and the parent
// must wait for both branches.
TEST(Par, BranchesOfBothPrioritiesJoin) {
  const auto found = isolated_numbers([] {
    Lab lab;
    Numbers ends(3);
    lab.cpu().start("parent", Priority::low, [&] {
      par({{"low", Priority::low, [&] { compute(5000), ends[0] = own_cycles(); }},
           {"high", Priority::high, [&] { compute(7000), ends[1] = own_cycles(); }}});
      // The high-priority branch has ended when the parent waits for it.
      par({{"high only", Priority::high, [] { compute(100); }}});
      ends[2] = own_cycles();
    });
    lab.machine.run();
    return ends;
  });
  EXPECT_LT(found.at(1), found.at(0));
  EXPECT_LT(found.at(0), found.at(2));
  const Model model = make_exact_model();
  const auto& costs = model.scheduler;
  // Two high-priority branches are started by runp; the low-priority branch is the parent itself.
  const Cycles branch = costs.par_branch + costs.run_process + costs.preemption +
                        costs.end_process + costs.return_to_low;
  EXPECT_EQ(found.at(2),
            5000 + 7000 + 100 + (2 * branch + 2 * (costs.par_setup + costs.end_process)).value);
}

// A PAR must cost the sum of its model entries. If the parent has low priority, a high-priority
// branch costs runp and two switches instead of startp.
TEST(Par, CostsItsRows) {
  for (const Model& model :
       {make_exact_model(), make_on_chip_model(), machine::load_model("t805-25")})
    for (auto priority : BOTH_PRIORITIES)
      for (std::int64_t n : {1, 2, 3, 8}) {
        const auto found = isolated_numbers([&] {
          Lab lab(model);
          lab.cpu().start("parent", priority, [&] {
            std::vector<Branch> branches(n, {"branch", priority, [] {}});
            par(std::span<const Branch>(branches));
          });
          lab.machine.run();
          return Numbers{lab.cycles()};
        });
        const auto& s = model.scheduler;
        EXPECT_NEAR(
            found.at(0),
            (s.par_setup + (n - 1) * (s.par_branch + s.start_process) + n * s.end_process).value,
            ROUNDING)
            << n << " branches";
      }
  // Published: startp takes 12 cycles, endp 13. A PAR of two branches has one startp and two endp.
  const auto& s = make_on_chip_model().scheduler;
  EXPECT_EQ((s.start_process + 2 * s.end_process).value, 12 + 2 * 13);
}

// PRI PAR: a high-priority branch must get the CPU as soon as it starts, and keep it until it
// blocks or ends.
TEST(Par, HighBranchOfALowParentRunsAtOnce) {
  const Model model = make_complete_model();
  const auto found = isolated_numbers([&] {
    Lab lab(model);
    Numbers at(4);
    lab.cpu().start("parent", Priority::low, [&] {
      par({{"high", Priority::high,
            [&] { at[0] = own_cycles(), compute(500), at[1] = own_cycles(); }},
           {"low", Priority::low, [&] { at[2] = own_cycles(); }}});
      at[3] = own_cycles();
    });
    lab.machine.run();
    return at;
  });
  const auto& s = model.scheduler;
  const Cycles started = s.par_setup + s.par_branch + s.run_process + s.preemption;
  EXPECT_EQ(found.at(0), started.value);
  EXPECT_EQ(found.at(1), started.value + 500);
  EXPECT_EQ(found.at(2), started.value + 500 + (s.end_process + s.return_to_low).value);
  EXPECT_EQ(found.at(3), started.value + 500 + (2 * s.end_process + s.return_to_low).value);
}

// The own time of a process that owes no charged cycles must be exact. It must include the time
// during which the process was without the CPU.
TEST(Par, ALowParentHasLostTheTimeOfAHighBranch) {
  const Model model = make_complete_model();
  const auto found = isolated_numbers([&] {
    Lab lab(model);
    Numbers at;
    lab.cpu().start("parent", Priority::low, [&] {
      par({{"high", Priority::high, [] { compute(500); }},
           {"low", Priority::low, [&] {
              const auto& self = this_process();
              at.push_back(self.own_time().value * self.processor().clock().value);
              at.push_back(own_cycles());
            }}});
    });
    lab.machine.run();
    return at;
  });
  EXPECT_EQ(found.at(0), found.at(1));
}

// A low-priority branch ends last and wakes its high-priority parent. This is no pre-emption,
// because the branch has ended.
TEST(Par, LowBranchOfAHighParentWakesIt) {
  const Model model = make_complete_model();
  for (int low : {1, 2}) {
    const auto found = isolated_numbers([&] {
      Lab lab(model);
      double end = 0;
      Processor& cpu = lab.cpu();
      cpu.start("parent", Priority::high, [&] {
        for (int turn = 0; turn < 2; ++turn) {
          std::vector<Branch> branches(low, {"low", Priority::low, [] { compute(100); }});
          par(std::span<const Branch>(branches));
        }
        end = own_cycles();
      });
      lab.machine.run();
      return Numbers{end, static_cast<double>(cpu.use().preemptions)};
    });
    const auto& s = model.scheduler;
    const Cycles each = s.par_branch + s.run_process + Cycles{100} + s.end_process;
    EXPECT_EQ(found.at(0), 2 * (s.par_setup + low * each + s.end_process).value);
    EXPECT_EQ(found.at(1), 0);
  }
}

TEST(Par, OfNothingCostsItsEnd) {
  const auto found = isolated_numbers([] {
    Lab lab;
    lab.cpu().start("parent", Priority::low, [] { par(std::span<const Branch>()); });
    lab.machine.run();
    return Numbers{lab.cycles()};
  });
  const auto& s = make_exact_model().scheduler;
  EXPECT_EQ(found.at(0), (s.par_setup + s.end_process).value);
}

double resident_pages() {
  std::ifstream statm("/proc/self/statm");
  double size = 0, resident = 0;
  statm >> size >> resident;
  return resident;
}

// Runs a PAR of two branches `turns` times. Returns the largest number of processes during the run,
// the number of processes at its end, and the growth of host memory after the first thousand turns,
// in 4 KB pages.
Numbers run_branches(int turns, const std::function<void(Channel<Words>&)>& read) {
  return isolated_numbers([&] {
    Lab lab;
    Processor& cpu = lab.cpu();
    auto& channel = lab.soft();
    double most = 0, before = 0;
    cpu.start("parent", Priority::low, [&] {
      for (int i = 0; i < turns; ++i) {
        par({{"reader", Priority::low, [&] { read(channel); }},
             {"writer", Priority::low, [&] { out(channel, {}); }}});
        most = std::max(most, static_cast<double>(cpu.processes().size()));
        if (i == 1000) before = resident_pages();
      }
    });
    lab.machine.run();
    return Numbers{most, static_cast<double>(cpu.processes().size()), resident_pages() - before};
  });
}

TEST(Par, LeavesNothingBehind) {
  const auto found = run_branches(100'000, [](Channel<Words>& channel) { channel.in(); });
  EXPECT_EQ(found.at(0), 1);
  EXPECT_EQ(found.at(1), 1);
#ifndef __SANITIZE_ADDRESS__  // the address sanitizer keeps freed memory
  EXPECT_LT(found.at(2), 500);
#endif
}

// Each branch leaves behind a timeout that does not fire. The timeouts must not keep branches
// alive.
TEST(Par, BranchesMayEndBeforeTheirTimeouts) {
  for (std::int64_t patience : {100, 1'000'000'000}) {
    const auto found = run_branches(50'000, [&](Channel<Words>& channel) {
      Words got;
      pri_alt(when(channel, got, [] {}), after(read_timer() + patience, [] {}));
    });
    EXPECT_EQ(found.at(0), 1);
    EXPECT_EQ(found.at(1), 1);
  }
}

}  // namespace
}  // namespace occam

// Two processors that share a memory (companions), and soft channels between them.
#include <random>

#include "tests/simulator/machine/failures.hpp"

namespace occam {
namespace {

struct Pair {
  explicit Pair(Lab& lab)
      : first(lab.cpu()),
        second(lab.machine.add_companion(first, "second")),
        to_second(lab.channels.emplace_back("there", first, second)),
        to_first(lab.channels.emplace_back("back", second, first)) {}
  Processor &first, &second;
  Channel<Words>&to_second, &to_first;
};

// The first process must pay channel.blocked. The second must pay, on its own CPU, for the copy and
// for waking the first. Then both must continue at once, without waiting for each other's CPU.
TEST(Companion, ARendezvousCostsThatOfASoftChannelAndAnEvent) {
  constexpr std::int64_t date = 100'000;
  const Model model = make_exact_model();
  for (const bool writer_first : {true, false})
    for (const auto priority : BOTH_PRIORITIES)
      for (const auto other : BOTH_PRIORITIES)
        for (const std::uint64_t bytes : {0, 4, 101}) {
          SCOPED_TRACE(
              fmt::format("{} {} {} {}", writer_first, name_of(priority), name_of(other), bytes));
          const auto found = isolated_numbers([&] {
            Lab lab(model);
            Pair pair(lab);
            Numbers ends(3);
            const auto meet = [&](bool writes) {
              if (writes)
                out(pair.to_second, Words{bytes, 7});
              else
                ends[2] = static_cast<double>(pair.to_second.in().content);
            };
            auto& early = writer_first ? pair.first : pair.second;
            auto& late = writer_first ? pair.second : pair.first;
            early.start("early", priority, [&] {
              meet(writer_first);
              ends[0] = own_cycles();
            });
            late.start("late", other, [&] {
              compute(date);
              meet(!writer_first);
              ends[1] = own_cycles();
            });
            lab.machine.run();
            ends.push_back(lab.busy_cycles(early));
            ends.push_back(lab.busy_cycles(late));
            return ends;
          });
          const double met = static_cast<double>(date + soft_cost(model, bytes) +
                                                 model.channel.wake_companion.value);
          EXPECT_EQ(found,
                    (Numbers{met, met, 7, static_cast<double>(model.channel.blocked.value), met}));
        }
}

// Two processes arrive at the channel at the same time, so neither finds the other there. The one
// that notices the other first must do the work of the process that arrives second.
TEST(Companion, TwoThatComeAtOnceMeet) {
  const Model model = make_exact_model();
  const auto found = isolated_numbers([&] {
    Lab lab(model);
    Pair pair(lab);
    Numbers ends(2);
    pair.first.start("writer", Priority::low, [&] {
      out(pair.to_second, Words{400});
      ends[0] = own_cycles();
    });
    pair.second.start("reader", Priority::low, [&] {
      pair.to_second.in();
      ends[1] = own_cycles();
    });
    lab.machine.run();
    return ends;
  });
  const auto met = static_cast<double>(soft_cost(model, 400) + model.channel.wake_companion.value);
  EXPECT_EQ(found, (Numbers{met, met}));
}

// An output on one CPU must wake an ALT on the other, at either priority.
TEST(Companion, AnOutputWakesAnAltOfTheOther) {
  for (const auto priority : BOTH_PRIORITIES)
    test::run_isolated([&] {
      Lab lab;
      Pair pair(lab);
      auto& own = lab.soft();
      double at = 0;
      pair.second.start("reader", priority, [&] {
        Words got;
        pri_alt(when(own, got, [] { ADD_FAILURE(); }),
                when(pair.to_second, got, [&] { at = own_cycles(); }));
        EXPECT_EQ(got.content, 5u);
      });
      pair.first.start("writer", Priority::low, [&] {
        compute(10'000);
        out(pair.to_second, Words{4, 5});
      });
      lab.machine.run();
      EXPECT_GT(at, 10'000);
      EXPECT_LT(at, 10'500);
    });
}

// Messages in both directions between random computations must arrive in order, and not before they
// were sent. No CPU may be busy for longer than the elapsed time.
TEST(Companion, AnyProgramOfTwoCpusKeepsItsOrder) {
  for (unsigned seed = 0; seed < 20; ++seed)
    test::run_isolated([&] {
      SCOPED_TRACE(seed);
      std::mt19937 random(seed);
      Lab lab;
      Pair pair(lab);
      double sent = 0, charged[] = {0, 0};
      const auto pause = [&](int who) {
        const auto cycles = static_cast<std::int64_t>(random() % 3 * (random() % 200));
        charged[who] += static_cast<double>(cycles);
        compute(cycles);
      };
      pair.first.start("asks", BOTH_PRIORITIES[seed % 2], [&] {
        for (std::uint64_t i = 0; i < 50; ++i) {
          pause(0);
          sent = own_cycles();
          out(pair.to_second, Words{random() % 50, i});
          EXPECT_EQ(pair.to_first.in().content, i + 1);
        }
      });
      pair.second.start("answers", BOTH_PRIORITIES[seed / 2 % 2], [&] {
        for (std::uint64_t i = 0; i < 50; ++i) {
          pause(1);
          Words got;
          if (i % 2 == 0)
            got = pair.to_second.in();
          else
            pri_alt(when(pair.to_second, got, [] {}));
          EXPECT_EQ(got.content, i);
          EXPECT_GE(own_cycles(), sent);
          out(pair.to_first, Words{4, i + 1});
        }
      });
      lab.machine.run();
      EXPECT_GE(lab.busy_cycles(pair.first), charged[0]);
      EXPECT_GE(lab.busy_cycles(pair.second), charged[1]);
      EXPECT_LE(std::max(lab.busy_cycles(pair.first), lab.busy_cycles(pair.second)), lab.cycles());
    });
}

TEST(Companion, BothComputeAtOnceAtTheShareThatTheModelLeaves) {
  for (const double share : {0.0, 0.5}) {
    Model model = make_exact_model();
    model.memory.companion_share = share;
    const auto found = isolated_numbers([&] {
      Lab lab(model);
      Pair pair(lab);
      for (auto* cpu : {&pair.first, &pair.second})
        cpu->start("computes", Priority::low, [] { compute(1000); });
      lab.machine.run();
      return Numbers{lab.cycles(), lab.busy_cycles(pair.first), lab.busy_cycles(pair.second)};
    });
    EXPECT_EQ(found, Numbers(3, 1000 / (1 - share)));
  }
}

// DMA of one processor's links takes cycles of the shared memory, so it must slow the companion
// down.
TEST(Companion, LinksOfOneStealFromTheOther) {
  const auto found = isolated_numbers([] {
    Lab lab(make_stealing_model());
    Pair pair(lab);
    auto& far = lab.neighbour(pair.first);
    auto& link = lab.hard(pair.first, far);
    pair.first.start("sends", Priority::low, [&] { out(link, Words{100'000}); });
    far.start("receives", Priority::low, [&] { link.in(); });
    double took = 0;
    pair.second.start("computes", Priority::low, [&] {
      wait_until_cycle(2048);
      const double since = own_cycles();
      compute(31'000);
      took = own_cycles() - since;
    });
    lab.machine.run();
    return Numbers{took};
  });
  EXPECT_NEAR(found.at(0), 32'000, ROUNDING);  // DMA takes 1/32 of the cycles
}

TEST(Companion, TheyHaveOneMemory) {
  expect_failure("OutOfMemory of cpu 0 at 0", {"the list asked for 1000 bytes, 576 of 1048576"},
                 [](Lab& lab) {
                   Pair pair(lab);
                   pair.first.memory().allocate(1'000'000, "the scene", {});
                   pair.second.memory().allocate(48'000, "the cache", {});
                   pair.second.start("allocates", Priority::low, [] {
                     this_process().processor().memory().allocate(1000, "the list", {});
                   });
                 });
}

TEST(Companion, OthersHaveNoChannelWithoutALink) {
  expect_failure("Misuse of cpu 0 at 0",
                 {"x would join cpu 0 and cpu 1, which share neither a link"}, [](Lab& lab) {
                   auto &a = lab.cpu(), &b = lab.cpu();
                   lab.channels.emplace_back("x", a, b);
                 });
  expect_failure("Misuse of cpu 0 at 0",
                 {"cpu 0 already has a companion, second: expected at most one"}, [](Lab& lab) {
                   Pair pair(lab);
                   lab.machine.add_companion(pair.first, "third");
                 });
  expect_failure("Misuse of reads at 0",
                 {"reads on cpu 0 inputs from channel there", "whose end for that is on second"},
                 [](Lab& lab) {
                   Pair pair(lab);
                   pair.first.start("reads", Priority::low,
                                    [&there = pair.to_second] { there.in(); });
                 });
}

}  // namespace
}  // namespace occam

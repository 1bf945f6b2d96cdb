// Cut links: which processes notice the cut and when, and which bytes are counted.
#include <gtest/gtest.h>

#include "tests/simulator/machine/failing_links.hpp"

namespace occam {
namespace {

constexpr double CUT = 5000;  // cycle at which the link is cut

double blocked() { return static_cast<double>(make_exact_model().channel.blocked.value); }

struct Try {
  bool forward;
  Priority priority;
  Side side;
  std::int64_t computes;
  std::uint64_t bytes = 8;
};

// Cuts the link at `cycle` while the processes of `tries` output and input. Returns for each
// process whether its message was moved, and the cycle at which its operation ended. The end of the
// run and the counts of messages and bytes follow.
Numbers try_all(double cycle, const std::vector<Try>& tries, int switches = 0) {
  return isolated_numbers([&] {
    CutPair pair(cycle, make_exact_model(), switches);
    auto& there = pair.lab.hard(pair.a, pair.b);
    auto& back = pair.lab.hard(pair.b, pair.a);
    std::deque<Attempt> attempts;
    for (const Try& t : tries) {
      Processor& cpu = t.forward == (t.side == Side::writer) ? pair.a : pair.b;
      attempts
          .emplace_back(
              Attempt{cpu, t.priority, t.side, t.forward ? there : back, t.computes, t.bytes})
          .start();
    }
    EXPECT_EQ(pair.lab.machine.run(), machine::End::done);
    Numbers all;
    for (const Attempt& attempt : attempts) {
      all.push_back(attempt.moved);
      all.push_back(attempt.end);
    }
    all.push_back(pair.lab.cycles());
    const auto use = pair.lab.machine.link(pair.a, pair.b).use();
    for (const auto number : {use.messages, use.bytes, use.bytes_sent, use.bytes_cut,
                              there.use().messages, there.use().bytes})
      all.push_back(static_cast<double>(number));
    all.push_back(use.busy.value * pair.lab.machine.model().cpu.clock.value);
    return all;
  });
}

// The cut must wake a process that waits for its partner, for either direction and either end.
TEST(LinkFailure, EndsAWaitForThePartner) {
  for (auto priority : BOTH_PRIORITIES)
    for (bool forward : {true, false})
      for (auto side : {Side::writer, Side::reader}) {
        const auto found = try_all(CUT, {{forward, priority, side, 100}});
        EXPECT_EQ(found, (Numbers{0, CUT, CUT, 0, 0, 0, 0, 0, 0, 0}));
      }
}

// A transfer starts after channel.blocked cycles and would take 16 cycles per byte. A cut before
// its end must fail it at both ends.
TEST(LinkFailure, EndsATransferThatNobodyGets) {
  for (auto writer : BOTH_PRIORITIES)
    for (auto reader : BOTH_PRIORITIES) {
      const auto found =
          try_all(CUT, {{true, writer, Side::writer, 0, 1000}, {true, reader, Side::reader, 0}});
      EXPECT_EQ(found, (Numbers{0, CUT, 0, CUT, CUT, 0, 0, 1000, 1000, 0, 0, CUT - blocked()}));
    }
}

TEST(LinkFailure, EndsTransfersOfBothDirections) {
  const auto found = try_all(CUT, {{true, Priority::high, Side::writer, 0, 1000},
                                   {true, Priority::high, Side::reader, 0},
                                   {false, Priority::low, Side::writer, 0, 1000},
                                   {false, Priority::low, Side::reader, 0}});
  for (std::size_t i : {0u, 2u, 4u, 6u}) {
    EXPECT_EQ(found.at(i), 0);
    EXPECT_EQ(found.at(i + 1), CUT);
  }
  EXPECT_EQ(found.at(8), CUT);
}

// A message that is cut while a link switch still delays its first byte must not move any byte.
TEST(LinkFailure, EndsAMessageInALinkSwitch) {
  const double just_begun = blocked() + 1;
  const auto found = try_all(
      just_begun,
      {{true, Priority::high, Side::writer, 0, 9}, {true, Priority::high, Side::reader, 0}}, 3);
  EXPECT_EQ(found, (Numbers{0, just_begun, 0, just_begun, just_begun, 0, 0, 9, 9, 0, 0, 1}));
}

// A transfer takes channel.blocked cycles and 16 cycles per byte. It must be complete if it ends
// before the cut.
TEST(LinkFailure, ComesTooLateForWhatHasArrived) {
  const double end = blocked() + 16 * 100;
  const std::vector<Try> tries{{true, Priority::high, Side::writer, 0, 100},
                               {true, Priority::low, Side::reader, 0}};
  EXPECT_EQ(try_all(end + 1, tries), (Numbers{1, end, 1, end, end, 1, 100, 100, 0, 1, 100, 1600}));
  EXPECT_EQ(try_all(end - 1, tries),
            (Numbers{0, end - 1, 0, end - 1, end - 1, 0, 0, 100, 100, 0, 0, 1599}));
}

// After a cut, an operation must fail at once and cost only channel.blocked.
TEST(LinkFailure, IsToldAtOnceWhenItWasBefore) {
  for (auto priority : BOTH_PRIORITIES)
    for (auto side : {Side::writer, Side::reader})
      for (double cut : {0.0, 300.0}) {
        const double end = cut > 0 ? 400 + blocked() : blocked();
        const auto found =
            try_all(cut, {{true, priority, side, static_cast<std::int64_t>(end - blocked())}});
        EXPECT_EQ(found, (Numbers{0, end, end, 0, 0, 0, 0, 0, 0, 0})) << cut;
      }
}

// One process waits. Its partner has charged cycles in advance, and so is ahead of the clock. The
// waiting process must fail at the cut, the other one when it reaches the link.
TEST(LinkFailure, BetweenTheTwoEndsOfAMeeting) {
  for (auto first : {Side::writer, Side::reader}) {
    const Side second = first == Side::writer ? Side::reader : Side::writer;
    const double end = 900 + blocked();
    const auto found = try_all(
        500, {{true, Priority::high, first, 0, 100}, {true, Priority::high, second, 900, 100}});
    EXPECT_EQ(found, (Numbers{0, 500, 0, end, end, 0, 0, 0, 0, 0, 0, 0}));
  }
}

// At the cut, the first process has charged cycles in advance, so that its own time is ahead of the
// clock. The second arrives after the cut, but before the own time of the first. Each must fail at
// its own time.
TEST(LinkFailure, IsToldThoughThePartnerIsAheadOfTheClock) {
  for (auto first : {Side::writer, Side::reader})
    for (auto priority : BOTH_PRIORITIES) {
      const Side second = first == Side::writer ? Side::reader : Side::writer;
      const double early = 550 + blocked(), late = 900 + blocked();
      const auto found =
          try_all(500, {{true, Priority::high, first, 900}, {true, priority, second, 550}});
      EXPECT_EQ(found, (Numbers{0, late, 0, early, late, 0, 0, 0, 0, 0, 0, 0}));
    }
}

// The link is cut during the tag of a message, between tag and contents, or during the contents.
TEST(LinkFailure, OfAVariantProtocolIsTheSameInBothItsParts) {
  for (double cut = 1; cut < 2 * blocked() + 16 * (1 + 8); cut += 3) {
    const auto found = isolated_numbers([&] {
      CutPair pair(cut);
      Channel<Words> channel("c", pair.lab.machine.link(pair.a, pair.b), Protocol::variant);
      Attempt writer{pair.a, Priority::high, Side::writer, channel};
      Attempt reader{pair.b, Priority::low, Side::reader, channel};
      writer.start();
      reader.start();
      pair.lab.machine.run();
      return Numbers{writer.moved, reader.moved};
    });
    EXPECT_EQ(found, (Numbers{0, 0})) << cut;
  }
}

// DMA takes 1/32 of the cycles until the cut. Then the computation gets all cycles again, and the
// writer is woken.
TEST(LinkFailure, GivesTheCyclesOfTheDmaBack) {
  const Model model = make_stealing_model();
  constexpr std::int64_t cycles = 20'000, moves = 3200;
  const auto found = isolated_numbers([&] {
    CutPair pair(blocked() + moves, model);
    auto& channel = pair.lab.hard(pair.a, pair.b);
    Attempt writer{pair.a, Priority::high, Side::writer, channel, 0, 10'000};
    Attempt reader{pair.b, Priority::high, Side::reader, channel};
    writer.start();
    reader.start();
    Numbers ends(2);
    for (int i : {0, 1})
      pair.lab.machine.processors()[i]->start("busy", Priority::low, [&, i] {
        compute(cycles);
        this_process().sync();
        ends[i] = own_cycles();
      });
    pair.lab.machine.run();
    return ends;
  });
  const auto& s = model.scheduler;
  for (double end : found)
    EXPECT_NEAR(end,
                blocked() + cycles + moves / 32 +
                    static_cast<double>((s.preemption + s.return_to_low).value),
                ROUNDING);
}

// A second cut, and a cut after the end of the run or after its limit, must have no effect.
TEST(LinkFailure, IsToldOnceAndNotAfterTheEnd) {
  const auto run = [](double cut, double end, double limit) {
    return isolated_numbers([=] {
      CutPair pair(cut);
      pair.lab.machine.cut_link(pair.b, pair.a, at_cycle(pair.lab, cut + 1));
      Numbers told;
      pair.lab.machine.on_failure([&](const machine::Failure& failure) {
        EXPECT_EQ(failure.a, &pair.a);
        EXPECT_EQ(failure.b, &pair.b);
        EXPECT_TRUE(pair.lab.machine.link(pair.b, pair.a).is_cut());
        told.push_back(failure.at.value * pair.lab.machine.model().cpu.clock.value);
      });
      pair.a.start("process", Priority::low, [=] {
        compute(static_cast<std::int64_t>(end));
        this_process().sync();
      });
      pair.lab.machine.run(at_cycle(pair.lab, limit));
      told.push_back(pair.lab.cycles());
      return told;
    });
  };
  EXPECT_EQ(run(1000, 3000, 1e9), (Numbers{1000, 3000}));
  EXPECT_EQ(run(3001, 3000, 1e9), (Numbers{3000}));
  EXPECT_EQ(run(2500, 3000, 2000), (Numbers{2000}));
}

}  // namespace
}  // namespace occam

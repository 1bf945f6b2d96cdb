// ALTs and deadlocks on links that are cut.
#include <gtest/gtest.h>

#include "tests/simulator/machine/failing_links.hpp"
#include "tests/simulator/machine/failures.hpp"

namespace occam {
namespace {

// A process waits in an ALT for a message or a timeout. wait_in_alt() returns three numbers. The
// first is 1 for the message, 0 for the timeout, or -1 if the link was cut after the message's
// guard was chosen. The second is the cycle at which the ALT ends. The third is 1 if the output
// succeeded, otherwise 0.
struct AltCase {
  double cut;
  Priority writer, reader;
  std::int64_t writer_computes;
  bool writes = true;
};
Numbers wait_in_alt(const AltCase& c) {
  return isolated_numbers([&] {
    CutPair pair(c.cut);
    auto& channel = pair.lab.hard(pair.a, pair.b);
    Attempt writer{pair.a, c.writer, Side::writer, channel, c.writer_computes, 40};
    if (c.writes) writer.start();
    Numbers found(2);
    std::optional<Words> got;
    // The timeout is at cycle 8192 for either priority.
    const std::int64_t deadline = c.reader == Priority::high ? 512 : 8;
    const auto message = [&] { return when(channel, got, [&] { found[0] = got ? 1 : -1; }); };
    const auto time_out = [&] { return after(deadline, [&] { found[0] = 0; }); };
    const auto with_stack = [&] {
      pri_alt(message(), time_out());
      this_process().sync();
      found[1] = own_cycles();
    };
    const auto without = [&]() -> Proc {
      co_await alternative(message(), time_out());
      co_await machine::Sync();
      found[1] = own_cycles();
    };
    if (bodies_have_stacks())
      pair.b.start("reader", c.reader, with_stack);
    else
      pair.b.start("reader", c.reader, without());
    pair.lab.machine.run();
    found.push_back(writer.moved);
    return found;
  });
}

TEST(AltFailure, AGuardOnACutLinkIsNeverReady) {
  for (auto writer : BOTH_PRIORITIES)
    for (auto reader : BOTH_PRIORITIES) {
      const auto silent = wait_in_alt({1e9, writer, reader, 0, false});
      ASSERT_EQ(silent.at(0), 0);
      // In the three cases the link is cut at the start, before the writer arrives, or while the
      // writer has charged cycles in advance.
      for (const auto& [cut, computes] : {std::pair{0.0, 0}, {500.0, 3000}, {500.0, 900}}) {
        const auto found = wait_in_alt({cut, writer, reader, computes});
        EXPECT_EQ(found.at(0), 0) << cut;
        EXPECT_EQ(found.at(1), silent.at(1)) << cut;
        EXPECT_EQ(found.at(2), 0) << cut;
      }
    }
}

// The link is cut at any cycle of the ALT. Either both ends must have moved the message, or
// neither.
TEST(AltFailure, MayComeAtAnyCycleOfAnAlt) {
  std::array<int, 3> seen{};
  for (auto writer : BOTH_PRIORITIES)
    for (auto reader : BOTH_PRIORITIES)
      for (int cut = 0; cut < 1200; cut += cut < 300 ? 2 : 100) {
        const auto found = wait_in_alt({static_cast<double>(cut), writer, reader, 60});
        EXPECT_EQ(found.at(0) == 1, found.at(2) == 1) << cut;
        ++seen.at(static_cast<std::size_t>(found.at(0) + 1));
      }
  for (int times : seen)
    // the three outcomes occur: a cut after the choice, a cut before it, and a cut after the
    // message
    EXPECT_GT(times, 0);
}

TEST(AltFailure, OtherGuardsGoOn) {
  const auto found = isolated_numbers([] {
    CutPair pair(0);
    auto& cut = pair.lab.hard(pair.a, pair.b);
    Processor& c = pair.lab.neighbour(pair.b);
    auto& whole = pair.lab.hard(c, pair.b);
    c.start("writer", Priority::low, [&] { out(whole, {8, 7}); });
    double content = 0;
    pair.b.start("reader", Priority::low, [&] {
      Words got;
      pri_alt(when(cut, got, [] {}), when(whole, got, [&] { content = 1.0 * got.content; }));
    });
    pair.lab.machine.run();
    return Numbers{content};
  });
  EXPECT_EQ(found, Numbers{7});
}

std::string deadlock_of(double cut, const std::function<void(Lab&, Processor&, Processor&)>& body) {
  return failure_of([&](Lab& lab) {
    Processor& a = lab.cpu();
    Processor& b = lab.neighbour(a);
    lab.machine.cut_link(a, b, at_cycle(lab, cut));
    body(lab, a, b);
  });
}

// A cut that changes nothing about a deadlock must not postpone the deadlock's date.
TEST(FailureDeadlock, SaysThatTheLinkIsCut) {
  const auto blocked = make_exact_model().channel.blocked.value;
  for (double cut : {0.0, 5000.0}) {
    const auto report = deadlock_of(cut, [](Lab& lab, Processor& a, Processor& b) {
      auto &there = lab.hard(a, b), &back = lab.hard(b, a);
      a.start("Alice", Priority::low, [&] { out(there, {}); });
      a.start("Bob", Priority::high, [&] { back.in(); });
    });
    EXPECT_TRUE(report.starts_with(fmt::format("Deadlock of machine at {}\n", 2 * blocked)))
        << report;
    EXPECT_NE(report.find("\n  Alice on cpu 0 waits for out on cpu 0 > cpu 1 (link cut)\n"
                          "  Bob on cpu 0 waits for in on cpu 1 > cpu 0 (link cut)"),
              std::string::npos)
        << report;
  }
}

// The process has charged cycles in advance. The link is cut before the clock reaches the own time
// at which the process uses the link. The cut must not postpone the date of the deadlock.
TEST(FailureDeadlock, IsNotPutOffByACutBeforeTheProcessComes) {
  const auto blocked = static_cast<double>(make_exact_model().channel.blocked.value);
  const auto report = deadlock_of(blocked / 2, [](Lab& lab, Processor& a, Processor& b) {
    auto& there = lab.hard(a, b);
    a.start("Alice", Priority::high, [&] { out(there, {}); });
  });
  EXPECT_TRUE(report.starts_with("Deadlock of machine at 0\n")) << report;
}

// After the cut, a process whose operation may fail must continue; any other blocks for ever. This
// is no deadlock if the blocked process is a server that inputs.
TEST(FailureDeadlock, OfATransferThatWasCut) {
  const auto run = [](bool is_server, bool writer_may_fail) {
    return deadlock_of(500, [=](Lab& lab, Processor& a, Processor& b) {
      auto& channel = lab.hard(a, b);
      a.start("Alice", Priority::low, [&channel, writer_may_fail] {
        writer_may_fail ? void(channel.out_or_fail({1000})) : channel.out({1000});
      });
      auto& bob = b.start("Bob", Priority::low, [&] { channel.in(); });
      if (is_server) bob.set_server();
    });
  };
  EXPECT_EQ(run(true, true), "nothing\n");
  const auto both = run(false, false), reader = run(false, true), writer = run(true, false);
  const std::string alice = "\n  Alice on cpu 0 waits for out on cpu 0 > cpu 1 (link cut)",
                    bob = "\n  Bob on cpu 1 waits for in on cpu 0 > cpu 1 (link cut)";
  for (const auto& report : {both, reader, writer})
    EXPECT_TRUE(report.starts_with("Deadlock of machine at 500\n")) << report;
  EXPECT_TRUE(both.ends_with(alice + bob)) << both;
  EXPECT_TRUE(reader.ends_with("any more:" + bob)) << reader;
  EXPECT_TRUE(writer.ends_with("any more:" + alice)) << writer;
}

TEST(FailureDeadlock, OfAnAltWhoseGuardsAreAllCut) {
  const auto report = deadlock_of(500, [](Lab& lab, Processor& a, Processor& b) {
    auto& channel = lab.hard(a, b);
    a.start("Alice", Priority::low, [&] { compute(1000), out(channel, {}); });
    b.start("Bob", Priority::low, [&] { select(std::array{Guard{&channel}}); });
  });
  EXPECT_NE(report.find("Bob on cpu 1 waits for alt on cpu 0 > cpu 1 (link cut)"),
            std::string::npos)
      << report;
}

}  // namespace
}  // namespace occam

// The report of a deadlock: the wait of each process, the processes that could end it, and the
// cycle of waits.
#include "tests/simulator/machine/failures.hpp"

namespace occam {
namespace {

std::string deadlock_at(Cycles cycle) {
  return fmt::format("Deadlock of machine at {}", cycle.value);
}

TEST(Deadlock, NamesProcessesAndChannels) {
  const Model costs = make_exact_model();
  // Each of two processes outputs and waits for the other to input.
  for (auto priority : BOTH_PRIORITIES)
    expect_failure(deadlock_at(2 * costs.channel.blocked),
                   {"deadlock at 0.000002 s", "\n  Alice on cpu 0 waits for out on soft 0",
                    "\n  Bob on cpu 0 waits for out on soft 1"},
                   [&](Lab& lab) {
                     auto &there = lab.soft(), &back = lab.soft();
                     auto& cpu = lab.cpu();
                     cpu.start("Alice", priority, [&] { out(there, Words{}), back.in(); });
                     cpu.start("Bob", priority, [&] { out(back, Words{}), there.in(); });
                     cpu.start("Carol", priority, [] {});
                   });
  EXPECT_EQ(failure_of([](Lab& lab) { lab.cpu().start("Carol", Priority::low, [] {}); }),
            "nothing\n");
}

TEST(Deadlock, NamesTheChannelsOfAnAlt) {
  const auto alt = make_exact_model().alternative;
  const Cycles waits = alt.setup + alt.wait_not;
  auto wait = [](Lab& lab, std::size_t guards) {
    auto &a = lab.soft(), &b = lab.soft();
    lab.cpu().start("Alice", Priority::low, [&, guards] {
      const std::array<Guard, 2> all{Guard{&a}, Guard{&b}};
      select(std::span(all).first(guards));
    });
  };
  expect_failure(deadlock_at(waits + alt.enable_not), {"Alice on cpu 0 waits for alt on", "soft 0"},
                 [&](Lab& lab) { wait(lab, 1); });
  expect_failure(deadlock_at(waits + 2 * alt.enable_not),
                 {"Alice on cpu 0 waits for alt on", "soft 0", "soft 1"},
                 [&](Lab& lab) { wait(lab, 2); });
}

TEST(Deadlock, OfALinkNamesItsEnds) {
  expect_failure(deadlock_at(make_exact_model().channel.blocked),
                 {"Alice on cpu 1 waits for in on cpu 0 > cpu 1"}, [](Lab& lab) {
                   auto& a = lab.cpu();
                   auto& b = lab.neighbour(a);
                   auto& channel = lab.hard(a, b);
                   b.start("Alice", Priority::low, [&] { channel.in(); });
                 });
}

// True if the report names the cycle before the list of waiting processes.
bool names_first(const std::string& report, const std::string& cycle) {
  const auto waits = report.find(" waits for ");
  return report.find("\n  the cycle: " + cycle + "\n") < waits;
}

// Processes form a ring, one on each processor. Each process takes a token from its predecessor and
// passes it on. Then all wait for the token again, which never comes.
void deadlock_ring(Lab& lab, int n) {
  std::vector<Processor*> cpus{&lab.cpu()};
  for (int i = 1; i < n; ++i) cpus.push_back(&lab.neighbour(*cpus.back()));
  if (n > 2) lab.machine.connect(*cpus.back(), *cpus.front());
  std::vector<Channel<Words>*> ring;  // channel i leads from process i to the next one
  for (int i = 0; i < n; ++i) ring.push_back(&lab.hard(*cpus[i], *cpus[(i + 1) % n]));
  for (int i = 0; i < n; ++i)
    cpus[i]->start(fmt::format("P{}", i), BOTH_PRIORITIES[i % 2], [=] {
      Channel<Words>&from = *ring[(i + n - 1) % n], &to = *ring[i];
      if (i == 0) out(to, Words{});
      from.in();
      if (i != 0) out(to, Words{});
      from.in();
    });
}

TEST(Deadlock, NamesTheCycleAcrossProcessors) {
  const auto report_of = [](int n) { return failure_of([n](Lab& lab) { deadlock_ring(lab, n); }); };
  const auto two = report_of(2), five = report_of(5);
  EXPECT_NE(two.find("nothing can happen any more:\n  the cycle: P0 -> P1 -> P0"
                     "\n  P0 on cpu 0 waits for in on cpu 1 > cpu 0 (from P1)"
                     "\n  P1 on cpu 1 waits for in on cpu 0 > cpu 1 (from P0)"),
            std::string::npos)
      << two;
  for (int i = 0; i < 5; ++i) {
    const auto before = (i + 4) % 5;
    const auto line = fmt::format("\n  P{} on cpu {} waits for in on cpu {} > cpu {} (from P{})", i,
                                  i, before, i, before);
    EXPECT_NE(five.find(line), std::string::npos) << line << " in: " << five;
  }
  EXPECT_TRUE(names_first(five, "P0 -> P4 -> P3 -> P2 -> P1 -> P0")) << five;
}

// A process outside the cycle also waits. The report must list it, but not as part of the cycle.
TEST(Deadlock, CycleLeavesOutWhoOnlyWaitsForIt) {
  const auto report = failure_of([](Lab& lab) {
    Processor& cpu = lab.cpu();
    auto &there = lab.soft(), &back = lab.soft(), &news = lab.soft();
    cpu.start("Olga", Priority::low, [&] { news.in(), news.in(); });
    cpu.start("Alice", Priority::low, [&] { out(there, {}), back.in(), out(news, {}), back.in(); });
    cpu.start("Bob", Priority::low, [&] { there.in(), out(back, {}), there.in(); });
  });
  EXPECT_NE(report.find("Olga on cpu 0 waits for in on soft 2 (from Alice)"), std::string::npos)
      << report;
  EXPECT_TRUE(names_first(report, "Alice -> Bob -> Alice")) << report;
}

TEST(Deadlock, FollowsTheGuardsOfAnAlt) {
  const auto report = failure_of([](Lab& lab) {
    Processor& hub = lab.cpu();
    std::array<Channel<Words>*, 2> to, from;
    for (int i = 0; i < 2; ++i) {
      Processor& leaf = lab.neighbour(hub);
      to[i] = &lab.hard(hub, leaf);
      from[i] = &lab.hard(leaf, hub);
      leaf.start(fmt::format("leaf {}", i), Priority::low,
                 [to = to[i], from = from[i]] { to->in(), out(*from, {}), to->in(); });
    }
    hub.start("hub", Priority::high, [to, from] {
      Words got;
      for (auto* channel : to) out(*channel, {});
      for (int i = 0; i < 3; ++i) pri_alt(when(*from[0], got, [] {}), when(*from[1], got, [] {}));
    });
  });
  EXPECT_NE(report.find("hub on cpu 0 waits for alt on cpu 1 > cpu 0, cpu 2 > cpu 0 (from leaf 0, "
                        "leaf 1)"),
            std::string::npos)
      << report;
  EXPECT_TRUE(names_first(report, "hub -> leaf 0 -> hub")) << report;
}

TEST(Deadlock, SaysThatThePartnerHasEnded) {
  const Model model = make_exact_model();
  expect_failure(deadlock_at(2 * model.channel.blocked + Cycles{soft_cost(model, 4)}),
                 {"Alice on cpu 0 waits for in on soft 0 (from a process that has ended)"},
                 [](Lab& lab) {
                   auto& channel = lab.soft();
                   auto& cpu = lab.cpu();
                   cpu.start("Alice", Priority::low, [&] { channel.in(), channel.in(); });
                   cpu.start("Bob", Priority::low, [&] { out(channel, {}); });
                 });
}

// A PAR waits for its branches. The report must name neither a branch that has ended, nor a later
// branch that was created at the same address.
TEST(Deadlock, OfAPar) {
  const auto report = failure_of([](Lab& lab) {
    auto& channel = lab.soft();
    Processor& cpu = lab.cpu();
    cpu.start("reader", Priority::low, [&] { channel.in(), channel.in(); });
    cpu.start("parent", Priority::low, [&] {
      par({{"writer", Priority::low, [&] { out(channel, {}); }}, {"own", Priority::low, [] {}}});
      for (int i = 0; i < 10; ++i)
        par({{"stuck", Priority::low,
              [&lab, i] {
                if (i == 9) lab.soft().in();
              }},
             {"own", Priority::low, [] {}}});
    });
  });
  EXPECT_NE(report.find("reader on cpu 0 waits for in on soft 0 (from a process that has ended)"),
            std::string::npos)
      << report;
  EXPECT_NE(report.find("parent on cpu 0 waits for the end of its PAR branches (from stuck)"),
            std::string::npos)
      << report;
  EXPECT_EQ(report.find("the cycle"), std::string::npos) << report;
}

// A branch waits for its parent, which waits for the branch in a PAR.
TEST(Deadlock, OfABranchAndItsParent) {
  const auto report = failure_of([](Lab& lab) {
    auto& channel = lab.soft();
    lab.cpu().start("parent", Priority::low, [&] {
      par({{"branch", Priority::low, [&] { channel.in(), channel.in(); }},
           {"own", Priority::low, [&] { out(channel, {}); }}});
    });
  });
  EXPECT_TRUE(names_first(report, "parent -> branch -> parent")) << report;
}

// Timers that no process waits for must not postpone the date of the deadlock.
TEST(Deadlock, IsFoundAtTheLastThingThatHappened) {
  const auto alt = make_exact_model().alternative;
  const auto report = failure_of([&](Lab& lab) {
    Processor& cpu = lab.cpu();
    auto &signal = lab.soft(), &never = lab.soft();
    cpu.start("reader", Priority::low, [&] {
      Words got;
      pri_alt(when(signal, got, [] {}), after(1000, [] {}));
      never.in();
    });
    cpu.start("writer", Priority::low, [&] { out(signal, {}); });
  });
  const Model model = make_exact_model();
  const Cycles end = alt.timer_setup + alt.enable_not + alt.enable_timer + alt.timer_wait_not +
                     model.channel.blocked + alt.disable + alt.disable_timer + alt.end +
                     Cycles{soft_cost(model, 4)} + model.channel.blocked;
  EXPECT_TRUE(report.starts_with(deadlock_at(end))) << report;
}

}  // namespace
}  // namespace occam

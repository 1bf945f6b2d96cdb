// Links: transfer times of a message alone, in both directions, on several links and over several
// hops.
#include <gtest/gtest.h>

#include "tests/support/lab.hpp"

namespace occam {
namespace {

// Tolerance in cycles, because SimGrid resolves only a picosecond.
constexpr double HAIR_CYCLES = 1e-3;

// A message from one processor to another. run_flows() starts all messages at once, and returns
// their arrivals in cycles after the start.
struct Flow {
  int from, to;
  std::uint64_t bytes;
};
Numbers run_flows(int processors, const std::vector<std::pair<int, int>>& links,
                  const std::vector<Flow>& flows) {
  constexpr std::int64_t start = 4096;
  return isolated_numbers([&] {
    Lab lab;
    for (int i = 0; i < processors; ++i) lab.cpu();
    const auto& cpus = lab.machine.processors();
    for (auto [a, b] : links) lab.machine.connect(*cpus[a], *cpus[b]);
    Numbers ends(flows.size());
    for (std::size_t i = 0; i < flows.size(); ++i) {
      auto& channel = lab.hard(*cpus[flows[i].from], *cpus[flows[i].to]);
      cpus[flows[i].from]->start("writer", Priority::low, [&channel, &flows, i] {
        wait_until_cycle(start);
        out(channel, {flows[i].bytes});
      });
      cpus[flows[i].to]->start("reader", Priority::low, [&channel, &ends, i] {
        channel.in();
        ends[i] = own_cycles() - start;
      });
    }
    lab.machine.run();
    return ends;
  });
}

// Times need a tolerance, because a CPU starts its transfers one after the other.
TEST(Link, DirectionsAloneReachOneRateAndTogetherShareTheOther) {
  const Model model = make_exact_model();
  const double clock = model.cpu.clock.value, one = model.link.one_way_rate / clock,
               half = model.link.both_ways_rate / clock / 2;  // in bytes per cycle
  constexpr std::uint64_t n = 100'000, m = 40'000;
  constexpr double slack = 200;
  EXPECT_NEAR(run_flows(2, {{0, 1}}, {{0, 1, n}}).at(0), n / one, slack);
  for (double end : run_flows(2, {{0, 1}}, {{0, 1, n}, {1, 0, n}}))
    EXPECT_NEAR(end, n / half, slack);
  const auto uneven = run_flows(2, {{0, 1}}, {{0, 1, n}, {1, 0, m}});
  EXPECT_NEAR(uneven.at(1), m / half, slack);
  EXPECT_NEAR(uneven.at(0), m / half + (n - m) / one, slack);
  // A star whose centre receives messages on two links and sends messages on two.
  for (double end :
       run_flows(5, {{0, 1}, {0, 2}, {3, 0}, {4, 0}}, {{0, 1, n}, {0, 2, n}, {3, 0, n}, {4, 0, n}}))
    EXPECT_NEAR(end, n / one, slack);
}

// A message meets another one in the opposite direction, which slows it down for a while. The
// fraction that has passed must follow the two rates.
TEST(Link, WhatHasPassedGrowsAsTheBytesMove) {
  const Model model = make_exact_model();
  const double clock = model.cpu.clock.value, one = model.link.one_way_rate / clock,
               half = model.link.both_ways_rate / clock / 2;  // in bytes per cycle
  constexpr double n = 10'000, m = 2'000, met_at = 40'000, every = 2'000;
  const auto passed = isolated_numbers([&] {
    Lab lab;
    auto& a = lab.cpu();
    auto& b = lab.neighbour(a);
    auto &there = lab.hard(a, b), &back = lab.hard(b, a);
    a.start("writer", Priority::low, [&] { out(there, {std::uint64_t(n)}); });
    b.start("reader", Priority::low, [&] { there.in(); });
    b.start("opposite", Priority::high, [&] {
      wait_until_cycle(std::int64_t(met_at));
      out(back, {std::uint64_t(m)});
    });
    a.start("answered", Priority::high, [&] { back.in(); });
    struct Look {
      machine::LinkDirection& link;
      Numbers passed = {};
    } look{lab.machine.link(a, b)};
    for (int i = 0; i < 120; ++i)
      a.engine().at({i * every / clock},
                    [&look] { look.passed.push_back(look.link.passed(look.link.from().now())); });
    lab.machine.run();
    return look.passed;
  });
  double before = 0;
  for (std::size_t i = 1; i < passed.size(); ++i) {
    const double cycle = double(i) * every, met = met_at + m / half;
    const double moved = cycle < met_at ? cycle * one
                         : cycle < met  ? met_at * one + (cycle - met_at) * half
                                        : met_at * one + m + (cycle - met) * one;
    if (moved > n) break;
    EXPECT_GE(passed[i], before);
    EXPECT_NEAR(passed[i], moved / n, 0.01) << "cycle " << cycle;
    before = passed[i];
  }
  EXPECT_GT(before, 0.9);
  EXPECT_EQ(passed.back(), 0);  // the message has arrived
}

// If nothing happens until a future date, the use predicted for that date must be right.
TEST(Link, UseIsForeseen) {
  for (const auto priority : {Priority::high, Priority::low}) {
    const auto seen = isolated_numbers([&] {
      Lab lab;
      auto& a = lab.cpu();
      auto& b = lab.neighbour(a);
      auto& channel = lab.hard(a, b);
      a.start("writer", Priority::high, [&] { out(channel, {100'000}); });
      b.start("reader", Priority::high, [&] { channel.in(); });
      a.start("worker", priority, [&] { compute(50'000); });
      const double clock = a.clock().value;
      struct Look {
        Processor& on;
        machine::LinkDirection& link;
        Seconds late;
        Numbers seen = {};
        void at(Seconds date) {
          for (const auto busy : {on.cpu().use_by(date).busy(), link.use_by(date).busy})
            seen.push_back(busy.value * on.clock().value);
        }
      } look{a, lab.machine.link(a, b), {20'000 / clock}};
      a.engine().at({10'000 / clock}, [&look] { look.at(look.late); });
      a.engine().at(look.late, [&look] { look.at(look.on.now()); });
      lab.machine.run();
      return look.seen;
    });
    ASSERT_EQ(seen.size(), 4u);
    EXPECT_NEAR(seen[0], seen[2], 1);
    EXPECT_NEAR(seen[1], seen[3], 1);
    EXPECT_GT(seen[0], 15'000);
    EXPECT_GT(seen[1], 15'000);
  }
}

// Each hop over an unloaded link must take the cost of starting the message plus bytes / rate. (The
// next reader is already waiting.)
TEST(Link, StoreAndForwardOverALine) {
  for (int hops : {1, 2, 7})
    for (std::uint64_t bytes : {1, 80, 3000}) {
      const auto found = isolated_numbers([&] {
        Lab lab;
        std::vector<Channel<Words>*> line;
        Processor* last = &lab.cpu();
        for (int i = 0; i < hops; ++i) {
          Processor& next = lab.neighbour(*last);
          line.push_back(&lab.hard(*last, next));
          last = &next;
        }
        double end = 0;
        for (int i = 0; i <= hops; ++i)
          lab.machine.processors()[i]->start("relay", Priority::high, [&, i] {
            const Words message = i > 0 ? line[i - 1]->in() : Words{bytes};
            i < hops ? out(*line[i], message) : void(end = own_cycles());
          });
        lab.machine.run();
        return Numbers{end};
      });
      const Model model = make_exact_model();
      const double hop =
          static_cast<double>(model.channel.blocked.value) +
          static_cast<double>(bytes) / model.link.one_way_rate * model.cpu.clock.value;
      EXPECT_NEAR(found.at(0), hops * hop, HAIR_CYCLES) << hops << " hops, " << bytes << " bytes";
    }
}

// For each built-in model at every link speed, the time must grow with the length as the model's
// rates say, for one direction and for both.
TEST(Link, RatesOfTheModelsAtEverySpeed) {
  constexpr std::uint64_t bytes = 100'000;
  for (const auto& name : machine::builtin_models())
    for (const double speed : {20e6, 10e6, 5e6}) {
      const Model model = machine::override_model(name, {{"link.bit_rate", speed}}, "tests");
      const auto found = isolated_numbers([&] {
        Lab lab(model);
        Processor& a = lab.cpu();
        Processor& b = lab.neighbour(a);
        Processor& c = lab.cpu();
        Processor& d = lab.neighbour(c);
        Numbers ends(3);
        const auto flow = [&](Processor& from, Processor& to, double& end) {
          auto& channel = lab.hard(from, to);
          from.start("writer", Priority::high, [&] { out(channel, {bytes}); });
          to.start("reader", Priority::high,
                   [&] { channel.in(), end = this_process().now().value; });
        };
        flow(a, b, ends[0]);
        flow(c, d, ends[1]);
        flow(d, c, ends[2]);
        lab.machine.run();
        return ends;
      });
      const double start =
          static_cast<double>(cost_first(model, Side::writer, bytes)) / model.cpu.clock.value;
      EXPECT_NEAR(found.at(0), start + bytes / model.link.one_way_rate, 1e-10) << name << speed;
      for (int i : {1, 2})  // a processor starts its second message slightly later
        EXPECT_NEAR(found.at(i), start + 2 * bytes / model.link.both_ways_rate, 2 * start)
            << name << " at " << speed;
    }
}

// On the real machine a word was measured to take 45 bit times (2.25 us); 1000 words take 2.25 ms.
TEST(Link, WordOfTheRealMachineTakesItsMeasuredTime) {
  const Model model = machine::load_model("t805-25");
  EXPECT_NEAR(4 / model.link.one_way_rate, 2.25e-6, 1e-15);
  EXPECT_NEAR(4000 / model.link.one_way_rate, 4000 * 11.25 / 20e6, 1e-12);
}

}  // namespace
}  // namespace occam

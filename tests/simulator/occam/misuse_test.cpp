// Misuse that the machine must refuse, with a message that names process, object, processor and
// date.
#include "tests/simulator/machine/failures.hpp"

namespace occam {
namespace {

constexpr std::int64_t COMES_AT = 20'000;  // cycle at which the second process arrives
constexpr std::uint64_t LONG = 100'000;    // in bytes; a transfer takes 1,600,000 cycles

std::string misuse_of(const std::string& who, std::int64_t cycle) {
  return fmt::format("Misuse of {} at {}", who, cycle);
}

using Use = std::function<void(Channel<Words>&)>;

void output_long(Channel<Words>& channel) { out(channel, Words{LONG}); }
void input(Channel<Words>& channel) { channel.in(); }
void input_by_alt(Channel<Words>& channel) {
  Words got;
  pri_alt(when(channel, got, [] {}));
}
void try_to_output(Channel<Words>& channel) { static_cast<void>(out_or_fail(channel, Words{})); }
void try_to_input(Channel<Words>& channel) { static_cast<void>(in_or_fail(channel)); }

struct Twins {
  bool writes, hard;
  Use first, second;
  // True if a partner arrives before the second process. On a hard channel, the message between the
  // first process and this partner is then in transit.
  bool partner_comes = true;
};

// Alice uses the channel from the start, Bob from COMES_AT on.
void start_twins(Lab& lab, const Twins& twins, Priority priority) {
  auto& a = lab.cpu();
  auto& b = twins.hard ? lab.neighbour(a) : a;
  auto& channel = twins.hard ? lab.hard(a, b) : lab.soft();
  auto& on = twins.writes ? a : b;
  on.start("Alice", priority, [&, use = twins.first] { use(channel); });
  if (twins.partner_comes)
    (twins.writes ? b : a).start("partner", priority, [&, writes = twins.writes] {
      writes ? void(channel.in()) : output_long(channel);
    });
  on.start("Bob", priority, [&, use = twins.second] {
    wait_until_cycle(COMES_AT);
    use(channel);
  });
}

void expect_second_refused(const Twins& twins, const std::string& does) {
  for (const auto priority : BOTH_PRIORITIES) {
    const std::string on = twins.hard && !twins.writes ? "cpu 1" : "cpu 0";
    const std::string report = failure_of([&](Lab& lab) { start_twins(lab, twins, priority); });
    const std::string channel = twins.hard ? "cpu 0 > cpu 1" : "soft 0";
    EXPECT_TRUE(report.starts_with("Misuse of Bob at ")) << report;
    const std::string text = fmt::format("Bob on {} {} channel {} at 0.00", on, does, channel);
    EXPECT_NE(report.find(text), std::string::npos) << "no \"" << text << "\" in: " << report;
    const std::string why =
        fmt::format(" s, which Alice on {} already uses: expected one writer and one reader", on);
    EXPECT_TRUE(report.ends_with(why)) << report;
  }
}

TEST(Misuse, ASecondWriterIsRefused) {
  for (const auto& second : {Use(output_long), Use(try_to_output)}) {
    expect_second_refused({true, true, output_long, second}, "outputs to");
    expect_second_refused({true, true, output_long, second, false}, "outputs to");
    expect_second_refused({true, false, output_long, second, false}, "outputs to");
  }
}

TEST(Misuse, ASecondReaderIsRefused) {
  for (const auto& first : {Use(input), Use(input_by_alt)})
    for (const auto& second : {Use(input), Use(input_by_alt), Use(try_to_input)}) {
      expect_second_refused({false, true, first, second}, "inputs from");
      expect_second_refused({false, true, first, second, false}, "inputs from");
      expect_second_refused({false, false, first, second, false}, "inputs from");
    }
}

// A low-priority process can lose the CPU between the first and the last instruction of an output.
// Another writer that arrives then must not change the message.
TEST(Misuse, ASecondWriterIsRefusedBeforeTheFirstWaits) {
  const std::string report = failure_of([](Lab& lab) {
    auto& cpu = lab.cpu();
    auto& channel = lab.soft();
    cpu.start("Alice", Priority::low, [&] {
      wait_until_cycle(COMES_AT);
      compute(100'000);
      out(channel, Words{4, 1});
    });
    cpu.start("Bob", Priority::high, [&] {
      wait_until_cycle(2 * COMES_AT);
      out(channel, Words{4, 2});
    });
    cpu.start("reader", Priority::low, [&] { EXPECT_EQ(channel.in().content, 1u); });
  });
  EXPECT_TRUE(report.starts_with("Misuse of Bob at ")) << report;
  EXPECT_NE(report.find("which Alice on cpu 0 already uses"), std::string::npos) << report;
}

// Several processes may use an end of a channel one after the other: in successive PARs, or after a
// message that hands it over to the next process.
TEST(Misuse, AnEndMayBeHandedOver) {
  for (const bool hard : {false, true}) {
    const auto found = isolated_numbers([&] {
      Lab lab;
      auto& a = lab.cpu();
      auto& b = hard ? lab.neighbour(a) : a;
      auto& channel = hard ? lab.hard(a, b) : lab.soft();
      auto& go = lab.soft();
      Numbers got;
      a.start("parent", Priority::low, [&] {
        for (const std::uint64_t i : {1, 2})
          par({{"branch", Priority::low,
                [&] {
                  out(channel, Words{4, i});
                }},
               {"own", Priority::low, [] {}}});
        out(channel, Words{4, 3});
        out(go, Words{});
      });
      a.start("other", Priority::high, [&] {
        go.in();
        out(channel, Words{4, 4});
      });
      b.start("reader", Priority::low, [&] {
        for (int i = 0; i < 4; ++i) got.push_back(static_cast<double>(channel.in().content));
      });
      lab.machine.run();
      return got;
    });
    EXPECT_EQ(found, (Numbers{1, 2, 3, 4}));
  }
}

// The second process starts early, but it charges cycles in advance. By its own time it arrives
// long after the first process has left.
TEST(Misuse, OneWhoComesLaterByItsOwnTimeIsNotRefused) {
  const auto found = isolated_numbers([] {
    Lab lab;
    auto& a = lab.cpu();
    auto& b = lab.neighbour(a);
    auto& channel = lab.hard(a, b);
    Numbers got;
    a.start("Alice", Priority::low, [&] { out(channel, Words{LONG, 1}); });
    a.start("Bob", Priority::low, [&] {
      compute(16 * 2 * LONG);
      out(channel, Words{4, 2});
    });
    b.start("reader", Priority::low, [&] {
      for (int i = 0; i < 2; ++i) got.push_back(static_cast<double>(channel.in().content));
    });
    lab.machine.run();
    return got;
  });
  EXPECT_EQ(found, (Numbers{1, 2}));
}

TEST(Misuse, ASoftChannelDoesNotLeaveItsProcessor) {
  for (const auto& second : {Use(input), Use(input_by_alt), Use(try_to_input)})
    expect_failure(misuse_of("Bob", COMES_AT),
                   {"Bob on cpu 1 inputs from channel soft 0 at 0.00119",
                    " s, which is a soft channel of cpu 0: expected a process there"},
                   [&](Lab& lab) {
                     auto& a = lab.cpu();
                     auto& b = lab.neighbour(a);
                     auto& channel = lab.soft();
                     a.start("Alice", Priority::high, [&] { output_long(channel); });
                     b.start("Bob", Priority::high, [&] {
                       wait_until_cycle(COMES_AT);
                       second(channel);
                     });
                   });
}

TEST(Misuse, AHardChannelHasItsWriterWhereTheLinkBegins) {
  const auto use = [](bool writes) {
    return [=](Lab& lab) {
      auto& a = lab.cpu();
      auto& b = lab.neighbour(a);
      auto& channel = lab.hard(a, b);
      (writes ? b : a).start("Alice", Priority::low, [&, writes] {
        writes ? output_long(channel) : input(channel);
      });
    };
  };
  expect_failure(misuse_of("Alice", 0),
                 {"Alice on cpu 1 outputs to channel cpu 0 > cpu 1 at 0.000000 s, which is on link "
                  "cpu 0 > cpu 1: expected a process on cpu 0"},
                 use(true));
  expect_failure(misuse_of("Alice", 0),
                 {"Alice on cpu 0 inputs from channel cpu 0 > cpu 1 at 0.000000 s, which is on "
                  "link cpu 0 > cpu 1: expected a process on cpu 1"},
                 use(false));
}

TEST(Misuse, ADirectionOfALinkHasOneChannel) {
  expect_failure(misuse_of("cpu 0", 0),
                 {"channel second is placed on link cpu 0 > cpu 1, which already carries channel "
                  "first: expected one channel for each direction of a link"},
                 [](Lab& lab) {
                   auto& a = lab.cpu();
                   auto& b = lab.neighbour(a);
                   Channel<Words> first("first", lab.machine.link(a, b));
                   Channel<Signal> back("back", lab.machine.link(b, a));
                   Channel<Signal> second("second", lab.machine.link(a, b));
                 });
}

TEST(Misuse, LinksJoinDifferentProcessors) {
  expect_failure(misuse_of("cpu 0", 0), {"cpu 0 would have a link to itself"}, [](Lab& lab) {
    auto& a = lab.cpu();
    lab.machine.connect(a, a);
  });
  expect_failure(misuse_of("cpu 0", 0),
                 {"found no link 2 between cpu 0 and cpu 1, expected numbers below 2"},
                 [](Lab& lab) {
                   auto &a = lab.cpu(), &b = lab.neighbour(a);
                   lab.machine.connect(a, b);
                   lab.machine.link(a, b, 2);
                 });
  expect_failure(misuse_of("cpu 0", 0), {"cpu 0 would have more than four links"}, [](Lab& lab) {
    auto& hub = lab.cpu();
    for (int i = 0; i < 5; ++i) lab.neighbour(hub);
  });
  expect_failure(misuse_of("cpu 0", 0), {"no link joins cpu 0 and cpu 1"}, [](Lab& lab) {
    auto &a = lab.cpu(), &b = lab.cpu();
    lab.machine.link(a, b);
  });
}

TEST(Misuse, AnAltHasAnOpenGuard) {
  const auto alt = make_exact_model().alternative;
  expect_failure(misuse_of("Alice", (alt.setup + alt.enable_not + alt.wait_not).value),
                 {"Alice on cpu 0 is in an ALT without an open guard at 0.000002 s"}, [](Lab& lab) {
                   auto& channel = lab.soft();
                   lab.cpu().start("Alice", Priority::low, [&] {
                     select(std::array{Guard{&channel, false}});
                   });
                 });
}

TEST(Misuse, AProcessTellsItsTimeOnlyToItself) {
  expect_failure(misuse_of("Alice", 0),
                 {"now() of Alice on cpu 0 was called outside this process at 0.000000 s"},
                 [](Lab& lab) {
                   auto& cpu = lab.cpu();
                   auto& alice = cpu.start("Alice", Priority::low, [] {});
                   cpu.start("Bob", Priority::high, [&] { alice.now(); });
                 });
}

// charge() must accept cycles as whole numbers and durations in seconds, but no bare number.
template <class... Amount>
concept CanCharge = requires(Process& process, Amount... amount) {
  process.charge({amount...});
};
template <class Amount>
concept CanChargeWithoutBraces = requires(Process& process, Amount amount) {
  process.charge(amount);
};
static_assert(CanCharge<Cycles> && CanCharge<Seconds>);
static_assert(CanChargeWithoutBraces<Cycles> && CanChargeWithoutBraces<Seconds>);
static_assert(!CanCharge<std::int64_t> && !CanCharge<double>);
static_assert(!CanChargeWithoutBraces<int> && !CanChargeWithoutBraces<double>);

TEST(Charge, TakesCyclesOrADuration) {
  Model model = make_exact_model();
  model.software.occam_factor = 3;  // a factor for compiled instructions only
  const auto found = isolated_numbers([&] {
    Lab lab(model, machine::Code::compiled);
    Numbers ends;
    lab.cpu().start("Alice", Priority::high, [&] {
      this_process().charge(Cycles{100});
      ends.push_back(own_cycles());
      this_process().charge(Seconds{100 * 0x1p-24});
      ends.push_back(own_cycles());
      charge(Seconds{100.4 * 0x1p-24});
      ends.push_back(own_cycles());
      charge(Cycles{100});
      ends.push_back(own_cycles());
    });
    lab.machine.run();
    return ends;
  });
  EXPECT_EQ(found, (Numbers{100, 200, 300, 600}));
}

TEST(Charge, ATurnOfALoopCostsItsRow) {
  Model model = make_exact_model();
  model.software.turn = Cycles{7};
  const auto found = isolated_numbers([&] {
    Lab lab(model);
    Numbers ends;
    lab.cpu().start("Alice", Priority::high, [&] {
      for (int i = 0; turn(i < 3); ++i) ends.push_back(own_cycles());
      ends.push_back(own_cycles());
    });
    lab.machine.run();
    return ends;
  });
  EXPECT_EQ(found, (Numbers{7, 14, 21, 28}));
}

}  // namespace
}  // namespace occam

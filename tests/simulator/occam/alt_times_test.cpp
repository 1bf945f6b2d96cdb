// Cost of an ALT on one processor, for both orders of arrival. Each time is a sum of entries of the
// model.
#include <gtest/gtest.h>

#include "tests/support/lab.hpp"

namespace occam {
namespace {

struct Case {
  bool alt_first;
  Priority reader, writer;
  int guards, chosen;  // number of channel guards, and the one that is written to
  bool skip;           // if true, the first guard is a SKIP with a false condition
  std::uint64_t bytes;
};

std::vector<Case> make_cases() {
  std::vector<Case> cases;
  for (bool alt_first : {true, false})
    for (auto reader : BOTH_PRIORITIES)
      for (auto writer : BOTH_PRIORITIES)
        for (int guards : {1, 2, 5})
          for (int chosen : {0, guards - 1})
            for (bool skip : {false, true})
              for (std::uint64_t bytes : {4, 40})
                cases.push_back({alt_first, reader, writer, guards, chosen, skip, bytes});
  return cases;
}

constexpr std::int64_t DATE = 102'400;  // cycle at which the second process arrives

struct Times {
  double reader, writer, busy;
};

Times expect_times(const Model& model, const Case& c) {
  const auto& alt = model.alternative;
  const auto& s = model.scheduler;
  const auto wait = model.timer.wait_future.value;
  auto enable = (alt.setup + c.guards * alt.enable_not).value;
  auto disable = (c.guards * alt.disable + alt.end).value;
  if (c.skip) {
    enable += alt.enable_skip.value;
    disable += alt.disable_skip.value;
  }
  // The input finds its partner waiting, and copies the message. If this wakes a high-priority
  // writer, a low-priority reader loses the CPU.
  const auto write = cost_first(model, Side::writer, c.bytes),
             read = cost_second(model, Side::reader, c.bytes);
  const bool preempted = c.reader == Priority::low && c.writer == Priority::high;
  const auto there = preempted ? s.preemption.value : 0,
             back = preempted ? s.return_to_low.value : 0;
  std::int64_t now = DATE, busy = wait;
  if (c.alt_first) {
    enable += alt.wait_not.value;  // the writer arrives long after this
    now += write + disable + read;
  } else {
    enable += (alt.enable_ready.value - alt.enable_not.value) + alt.wait_ready.value;
    now += enable + disable + read;
  }
  busy += enable + disable + write + read + there + back;
  return {static_cast<double>(now + there + back), static_cast<double>(now + there),
          static_cast<double>(busy)};
}

void run_case(Lab& lab, const Case& c, Times& times) {
  Processor& cpu = lab.cpu();
  std::vector<Channel<Words>*> channels;
  for (int i = 0; i < c.guards; ++i) channels.push_back(&lab.soft());
  cpu.start("reader", c.reader, [&times, c, channels] {
    if (!c.alt_first) wait_until_cycle(DATE);
    std::vector<Guard> guards;
    if (c.skip) guards.emplace_back(nullptr, false);
    for (auto* channel : channels) guards.emplace_back(channel);
    const auto taken = select(guards) - (c.skip ? 1 : 0);
    channels.at(taken)->in();
    times.reader = own_cycles();
  });
  cpu.start("writer", c.writer, [&times, c, channels] {
    if (c.alt_first) wait_until_cycle(DATE);
    out(*channels.at(c.chosen), {c.bytes});
    times.writer = own_cycles();
  });
}

void expect_alt_times(const Model& model) {
  const auto cases = make_cases();
  const auto found = isolated_numbers([&] {
    Lab lab(model);
    std::deque<Times> times(cases.size());
    for (std::size_t i = 0; i < cases.size(); ++i) run_case(lab, cases[i], times[i]);
    lab.machine.run();
    Numbers all;
    for (std::size_t i = 0; i < cases.size(); ++i)
      all.insert(all.end(),
                 {times[i].reader, times[i].writer, lab.busy_cycles(*lab.machine.processors()[i])});
    return all;
  });
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Case& c = cases[i];
    SCOPED_TRACE(
        fmt::format("{}: {} first, reader {}, writer {}, {} of {} guards, {} skip, {} bytes",
                    model.name, c.alt_first ? "ALT" : "writer", name_of(c.reader),
                    name_of(c.writer), c.chosen, c.guards, c.skip ? "a" : "no", c.bytes));
    const Times expected = expect_times(model, c);
    EXPECT_NEAR(found.at(3 * i), expected.reader, ROUNDING);
    EXPECT_NEAR(found.at(3 * i + 1), expected.writer, ROUNDING);
    EXPECT_NEAR(found.at(3 * i + 2), expected.busy, ROUNDING);
  }
}

TEST(AltTimes, AreSumsOfRowsForBothOrdersOfArrival) {
  expect_alt_times(make_complete_model());
  expect_alt_times(make_on_chip_model());
  expect_alt_times(machine::load_model("t805-25"));
  expect_alt_times(machine::load_model("t800-20"));
}

// The published cycles with on-chip memory for n guards, none of them ready: alt 2+1, n enbc 5+1,
// altwt 17+1, n disc 8+1, altend 4+1. The operands of each enbc and disc are added: ldl takes 2
// cycles and ldc 1. The offset of each disc takes 1 more.
TEST(AltTimes, OnChipAreThePublishedNumbers) {
  const auto alt = make_on_chip_model().alternative;
  for (std::int64_t n : {1, 2, 5}) {
    EXPECT_EQ((alt.setup + n * alt.enable_not + alt.wait_not).value, 3 + n * (6 + 3) + 18);
    EXPECT_EQ((n * alt.disable + alt.end).value, n * (9 + 4) + 5);
  }
}

// The cost of an ALT with SKIP only: alt, enbs, altwt (ready), diss, altend. Nothing is input.
TEST(AltTimes, SkipIsNeverWaitedFor) {
  for (const Model& model : {make_complete_model(), machine::load_model("t805-25")})
    for (auto priority : BOTH_PRIORITIES)
      for (int guards : {0, 3}) {
        const auto found = isolated_numbers([&] {
          Lab lab(model);
          Numbers end;
          std::vector<Guard> all;
          for (int i = 0; i < guards; ++i) all.emplace_back(&lab.soft());
          all.emplace_back();
          lab.cpu().start("reader", priority, [&] {
            const auto taken = select(all);
            end = {own_cycles(), static_cast<double>(taken)};
          });
          lab.machine.run();
          return end;
        });
        const auto& alt = model.alternative;
        EXPECT_NEAR(found.at(0),
                    (alt.setup + guards * alt.enable_not + alt.enable_skip + alt.wait_ready +
                     guards * alt.disable + alt.disable_skip + alt.end)
                        .value,
                    ROUNDING);
        EXPECT_EQ(found.at(1), guards);
      }
}

// The software factor must multiply each of an ALT's instructions, but not the work of the
// hardware.
TEST(AltTimes, SoftwareFactorMultipliesInstructionsOnly) {
  const Model model = make_complete_model();
  const auto cost = [&](double factor) {
    return isolated_numbers([&] {
             Model its = model;
             its.software.occam_factor = factor;
             Lab lab(its, machine::Code::compiled);
             double end = 0;
             Processor& cpu = lab.cpu();
             auto& channel = lab.soft();
             cpu.start("reader", Priority::low, [&] {
               Words got;
               pri_alt(when(channel, got, [] {}), otherwise(false, [] {}));
               end = own_cycles();
             });
             cpu.start("writer", Priority::high, [&] {
               compute(1000);
               out(channel, {40});
             });
             lab.machine.run();
             return Numbers{end};
           })
        .at(0);
  };
  const auto& s = model.scheduler;
  const double switches = static_cast<double>((s.preemption + s.return_to_low).value);
  const double copy = 10 * static_cast<double>(model.channel.copy_word.value);
  const double once = cost(1) - 1000 - switches - copy;
  for (double factor : {2.0, 4.0, 8.0})
    EXPECT_EQ(cost(factor), 1000 + switches + copy + factor * once) << factor;
}

}  // namespace
}  // namespace occam

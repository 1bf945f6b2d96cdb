// Channels on one processor: end and cost of a rendezvous, and the message's contents.
#include <gtest/gtest.h>

#include "tests/support/lab.hpp"

namespace occam {
namespace {

constexpr std::uint64_t SOFT_LENGTHS[] = {0, 1, 4, 5, 8, 100, 4001};

struct SoftCase {
  bool writer_first;
  Priority first, second;
  std::uint64_t bytes;
};

std::vector<SoftCase> make_soft_cases() {
  std::vector<SoftCase> cases;
  for (bool writer_first : {true, false})
    for (auto first : BOTH_PRIORITIES)
      for (auto second : BOTH_PRIORITIES)
        for (auto bytes : SOFT_LENGTHS) cases.push_back({writer_first, first, second, bytes});
  return cases;
}

// The first process pays for its operands and channel.blocked. The second arrives at `date` and
// pays for its operands, channel.soft_setup and the copy. Then both continue, where a high-priority
// process pre-empts a low-priority one.
void expect_soft_times(const Model& model) {
  constexpr std::int64_t date = 102'400;  // a tick of every clock
  const auto cases = make_soft_cases();
  const auto found = isolated_numbers([&] {
    Lab lab(model);
    // Ends of the first and of the second process, and the received value.
    std::deque<std::array<double, 3>> ends(cases.size());
    for (std::size_t i = 0; i < cases.size(); ++i) {
      auto& channel = lab.soft();
      auto meet = [&, i](bool writes) {
        if (writes)
          out(channel, {cases[i].bytes, i});
        else
          ends[i][2] = static_cast<double>(channel.in().content);
      };
      Processor& cpu = lab.cpu();
      cpu.start("first", cases[i].first, [&, meet, i] {
        meet(cases[i].writer_first);
        ends[i][0] = own_cycles();
      });
      cpu.start("second", cases[i].second, [&, meet, i] {
        wait_until_cycle(date);
        meet(!cases[i].writer_first);
        ends[i][1] = own_cycles();
      });
    }
    lab.machine.run();
    Numbers all;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      all.insert(all.end(), ends[i].begin(), ends[i].end());
      all.push_back(lab.busy_cycles(*lab.machine.processors()[i]));
    }
    return all;
  });
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const auto& c = cases[i];
    SCOPED_TRACE(fmt::format("{} first, {} then {}, {} bytes", c.writer_first ? "writer" : "reader",
                             name_of(c.first), name_of(c.second), c.bytes));
    const Side first = c.writer_first ? Side::writer : Side::reader,
               second = c.writer_first ? Side::reader : Side::writer;
    const bool preempts = c.first == Priority::high && c.second == Priority::low;
    const auto there = preempts ? model.scheduler.preemption.value : 0;
    const auto back = preempts ? model.scheduler.return_to_low.value : 0;
    const auto cost = cost_second(model, second, c.bytes);
    EXPECT_NEAR(found.at(4 * i), date + cost + there, ROUNDING);
    EXPECT_NEAR(found.at(4 * i + 1), date + cost + there + back, ROUNDING);
    EXPECT_EQ(found.at(4 * i + 2), i);
    EXPECT_NEAR(
        found.at(4 * i + 3),
        model.timer.wait_future.value + cost_first(model, first, c.bytes) + cost + there + back,
        ROUNDING);
  }
}

TEST(SoftRendezvous, TakesTheOperandsSetupAndCopyOfTheSecondToCome) {
  expect_soft_times(make_exact_model());
  expect_soft_times(make_complete_model());
  expect_soft_times(make_on_chip_model());
  expect_soft_times(machine::load_model("t805-25"));
  expect_soft_times(machine::load_model("t414-20"));
}

// The published costs in cycles with on-chip memory: in and out take 2w + 19 for w words, and
// outword takes two more. The process that arrives first takes 20. The operands take 4.
TEST(SoftRendezvous, OnChipIsThePublishedNumber) {
  const Model model = make_on_chip_model();
  for (auto bytes : SOFT_LENGTHS) {
    const std::int64_t w = words_in(bytes), one_word = bytes == 4 ? 2 : 0;
    EXPECT_EQ(cost_first(model, Side::reader, bytes), 4 + 20);
    EXPECT_EQ(cost_first(model, Side::writer, bytes), 4 + 20 + one_word);
    EXPECT_EQ(cost_second(model, Side::reader, bytes), 4 + 2 * w + 19);
    EXPECT_EQ(cost_second(model, Side::writer, bytes), 4 + 2 * w + 19 + one_word);
  }
}

// A message of no bytes: nothing is copied, but the two processes must still meet.
TEST(SoftRendezvous, OfNoBytes) {
  const Model model = make_complete_model();
  for (auto first : BOTH_PRIORITIES)
    for (auto second : BOTH_PRIORITIES) {
      const auto found = isolated_numbers([&] {
        Lab lab(model);
        auto& channel = lab.soft();
        Processor& cpu = lab.cpu();
        cpu.start("reader", first, [&] { channel.in(); });
        cpu.start("writer", second, [&] { wait_until_cycle(4096), out(channel, {0}); });
        lab.machine.run();
        return Numbers{lab.busy_cycles(cpu)};
      });
      const bool preempts = first == Priority::high && second == Priority::low;
      EXPECT_EQ(
          found.at(0),
          model.timer.wait_future.value + cost_first(model, Side::reader, 0) +
              cost_second(model, Side::writer, 0) +
              (preempts ? model.scheduler.preemption + model.scheduler.return_to_low : Cycles{0})
                  .value);
    }
}

TEST(SoftRendezvous, CompiledOccamMultipliesItsInstructions) {
  Model model = make_exact_model();
  model.software.occam_factor = 2.5;
  const auto found = isolated_numbers([&] {
    Lab lab(model, machine::Code::compiled);
    double end = 0;
    auto& channel = lab.soft();
    Processor& cpu = lab.cpu();
    cpu.start("writer", Priority::low, [&] { out(channel, {8}); });
    cpu.start("reader", Priority::low, [&] {
      channel.in();
      compute(1000);  // computation that the factor does not multiply
      end = own_cycles();
      this_process().sync();
    });
    lab.machine.run();
    return Numbers{end};
  });
  const auto blocked = static_cast<double>(model.channel.blocked.value);
  const auto setup = static_cast<double>(model.channel.soft_setup.value);
  const auto copy = static_cast<double>(soft_cost(model, 8)) - setup;  // part done by microcode
  EXPECT_EQ(found.at(0), std::round(2.5 * blocked) + std::round(2.5 * setup) + copy + 1000);
}

// On a transputer, `in` and `out` are single instructions, and the second process does the copy. A
// high-priority process may arrive during this instruction of a low-priority process; either of
// them may then be the first.
TEST(SoftRendezvous, IsCopiedWhenAHighProcessComesDuringTheInstructionOfALowOne) {
  constexpr std::uint64_t bytes = 4000;
  const Model model = make_exact_model();
  for (bool low_writes : {true, false}) {
    const auto found = isolated_numbers([&] {
      Lab lab;
      auto& channel = lab.soft();
      auto meet = [&](bool writes) { writes ? out(channel, {bytes}) : void(channel.in()); };
      Processor& cpu = lab.cpu();
      cpu.start("high", Priority::high, [&] {
        wait_until_cycle(64);
        meet(!low_writes);
      });
      cpu.start("low", Priority::low, [&] {
        compute(64 - model.channel.blocked.value / 2 - model.timer.wait_future.value);
        meet(low_writes);
        this_process().sync();
      });
      lab.machine.run();
      return Numbers{lab.busy_cycles(cpu)};
    });
    EXPECT_GE(found.at(0), soft_cost(model, bytes)) << (low_writes ? "low writes" : "low reads");
  }
}

}  // namespace
}  // namespace occam

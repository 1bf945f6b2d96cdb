// Cycles in the built-in models, compared with the published tables, which assume on-chip memory.
#include <gtest/gtest.h>

#include "base/errors.hpp"
#include "tests/support/lab.hpp"

namespace occam {
namespace {

// Cycles for loading operands from on-chip memory, and for the prefix of a two-byte instruction.
constexpr int LDLP = 1, LDL = 2, LDC = 1, PREFIX = 1;

struct Row {
  const char* instruction;
  Cycles found;
  std::int64_t published;
};

std::vector<Row> make_rows(const Model& model) {
  const auto& s = model.scheduler;
  const auto& c = model.channel;
  const auto& a = model.alternative;
  const auto& t = model.timer;
  return {
      {"operands of in and out", c.operands, LDLP + LDL + LDC},
      {"in, out, blocked", c.blocked, 20},
      {"in, out, no word", c.soft_setup, 19},
      {"in, out, of 10 words", c.soft_setup + 10 * c.copy_word, 2 * 10 + 19},
      {"outword less out, in the data book", c.out_word, 23 - 21},
      {"startp", s.start_process, 12},
      {"endp", s.end_process, 13},
      {"runp", s.run_process, 10 + PREFIX},
      {"low to high", s.preemption, 19},
      {"high to low", s.return_to_low, 17},
      {"alt", a.setup, 2 + PREFIX},
      {"talt", a.timer_setup, 4 + PREFIX},
      {"enbc, ready", a.enable_ready, 7 + PREFIX + LDL + LDC},
      {"enbc, not ready", a.enable_not, 5 + PREFIX + LDL + LDC},
      {"enbs", a.enable_skip, 3 + PREFIX + LDC},
      {"enbt", a.enable_timer, 8 + PREFIX + LDL + LDC},
      {"altwt, ready", a.wait_ready, 5 + PREFIX},
      {"altwt, waits", a.wait_not, 17 + PREFIX},
      {"taltwt, ready", a.timer_wait_ready, 15 + PREFIX},
      {"taltwt, waits", a.timer_wait_not, 48 + PREFIX},
      {"disc", a.disable, 8 + PREFIX + LDL + LDC + LDC},
      {"diss", a.disable_skip, 4 + PREFIX + LDC + LDC},
      {"dist", a.disable_timer, 23 + PREFIX + LDL + LDC + LDC},
      {"altend", a.end, 4 + PREFIX},
      {"ldtimer", t.read, 2 + PREFIX},
      {"tin, past", t.wait_past, 4 + PREFIX + LDL},
      {"tin, waits", t.wait_future, 30 + PREFIX + LDL},
  };
}

TEST(InstructionTable, IsThePublishedOneInEveryModel) {
  for (const auto& name : machine::builtin_models()) {
    const Model model = machine::override_model(name,
                                                {{"memory.data_word", "memory.on_chip_word"},
                                                 // No published table contains the time of
                                                 // instruction fetch.
                                                 {"instruction.fetch", 0.0}},
                                                "tests");
    for (const Row& row : make_rows(model))
      EXPECT_EQ(row.found.value, row.published) << name << ": " << row.instruction;
    EXPECT_EQ(model.timer.high_tick, 1e-6) << name;
    EXPECT_EQ(model.timer.low_tick, 64e-6) << name;
    EXPECT_EQ(model.memory.steal_word, 1) << name;
  }
}

// When a jump breaks the stream of instructions, the next word of code must be fetched. The
// published tables do not contain this time.
TEST(InstructionTable, BreaksOfTheStreamFetchTheNextInstructions) {
  const Model without_fetch = make_on_chip_model(),
              on_chip = machine::override_model(
                  "t805-25", {{"memory.data_word", 1.0}, {"memory.code_word", 1.0}}, "tests");
  const Model off_chip = machine::load_model("t805-25");
  EXPECT_EQ(machine::get_instruction(on_chip, "fetch").value, 2);
  EXPECT_EQ(machine::get_instruction(off_chip, "fetch").value, 4);
  for (const char* instruction : {"j", "lend", "call", "ret"})
    EXPECT_EQ(machine::get_instruction(on_chip, instruction),
              machine::get_instruction(without_fetch, instruction) + Cycles{2})
        << instruction;
  const std::pair<Cycles, Cycles> broken[] = {
      {on_chip.channel.blocked, without_fetch.channel.blocked},
      {on_chip.scheduler.end_process, without_fetch.scheduler.end_process},
      {on_chip.alternative.wait_not, without_fetch.alternative.wait_not},
      {on_chip.alternative.timer_wait_not, without_fetch.alternative.timer_wait_not},
      {on_chip.alternative.end, without_fetch.alternative.end},
      {on_chip.timer.wait_future, without_fetch.timer.wait_future}};
  for (const auto& [found, without] : broken) EXPECT_EQ(found, without + Cycles{2});
  EXPECT_EQ(on_chip.channel.soft_setup, without_fetch.channel.soft_setup);
  EXPECT_EQ(on_chip.scheduler.preemption, without_fetch.scheduler.preemption);
}

TEST(InstructionTable, ClocksAndSlices) {
  const std::tuple<const char*, double, std::int64_t> published[] = {
      {"t414-20", 20e6, 20'480},
      {"t800-20", 20e6, 20'480},
      {"t805-25", 25e6, 25'600},
      {"t805-30", 30e6, 30'720},  // cycles in 5120 periods of a 5 MHz clock
  };
  for (auto [name, clock, slice] : published) {
    const Model model = machine::load_model(name);
    EXPECT_EQ(model.cpu.clock.value, clock) << name;
    EXPECT_EQ(model.scheduler.slice.value, slice) << name;
  }
}

// Bit times per byte at the three link speeds, for one direction alone and for both together.
TEST(InstructionTable, LinkRates) {
  struct Speed {
    const char* name;
    double bit_rate, one_way, both_ways;
  };
  const Speed published[] = {
      {"t805-25", 20e6, 20e6 / 11.25, 2.35e6}, {"t805-25", 10e6, 0.91e6, 1.25e6},
      {"t805-25", 5e6, 0.45e6, 0.67e6},        {"t800-20", 20e6, 20e6 / 11.25, 2.35e6},
      {"t805-30", 10e6, 0.91e6, 1.25e6},       {"t414-20", 20e6, 20e6 / 25, 1.6e6},
      {"t414-20", 10e6, 10e6 / 25, 0.8e6},     {"t414-20", 5e6, 5e6 / 25, 0.4e6},
  };
  for (const Speed& p : published) {
    const Model model = machine::override_model(p.name, {{"link.bit_rate", p.bit_rate}}, "tests");
    EXPECT_NEAR(model.link.one_way_rate, p.one_way, 1e-3) << p.name << " at " << p.bit_rate;
    EXPECT_NEAR(model.link.both_ways_rate, p.both_ways, 1e-3) << p.name << " at " << p.bit_rate;
    EXPECT_LT(model.link.one_way_rate, model.link.both_ways_rate);
    EXPECT_LE(model.link.both_ways_rate, 2 * model.link.one_way_rate);
  }
}

TEST(InstructionTable, FloatingPointIsSinglePrecisionWithItsPrefix) {
  const Model model = make_on_chip_model();
  EXPECT_EQ(machine::get_instruction(model, "add").value, 6 + PREFIX);
  EXPECT_EQ(machine::get_instruction(model, "mul").value, 11 + PREFIX);
  EXPECT_EQ(machine::get_instruction(model, "div").value, 16 + PREFIX);
  EXPECT_EQ(machine::get_instruction(model, "load").value, 2 + PREFIX);
  EXPECT_EQ(machine::get_instruction(model, "j").value, 3);
  EXPECT_EQ(machine::get_instruction(model, "lend").value, 10);
  EXPECT_EQ(machine::get_instruction(model, "call").value, 7);
  EXPECT_EQ(machine::get_instruction(model, "ret").value, 5);
  EXPECT_EQ(machine::get_instruction(model, "stl").value, 1);
  EXPECT_THROW(machine::get_instruction(model, "fly"), base::BadInput);
}

}  // namespace
}  // namespace occam

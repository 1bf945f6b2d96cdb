// C004 link switches on a link between two processors.
#include <gtest/gtest.h>

#include "tests/support/lab.hpp"

namespace occam {
namespace {

// Returns the date in seconds at which the message has arrived. Each switch delays the first byte,
// and increases the time for every further byte.
double time_through(const Model& model, int switches, std::uint64_t bytes) {
  return isolated_numbers([&] {
           Lab lab(model);
           Processor &a = lab.cpu(), &b = lab.cpu();
           lab.machine.connect(a, b, switches);
           auto& channel = lab.hard(a, b);
           a.start("writer", Priority::high, [&] { out(channel, {bytes}); });
           b.start("reader", Priority::high, [&] { channel.in(); });
           lab.machine.run();
           return Numbers{lab.machine.now().value};
         })
      .at(0);
}

TEST(LinkSwitch, AddsItsDelayAndLengthensTheByte) {
  struct Case {
    const char* model;
    double bit_rate;
    int switches;
    double byte_bits;  // bit times for each byte
  };
  const Case published[] = {
      {"t805-25", 20e6, 0, 11.25},
      {"t805-25", 20e6, 1, 15.05},
      {"t805-25", 20e6, 2, 18.85},
      {"t805-25", 20e6, 3, 22.65},
      {"t805-25", 10e6, 1, 10e6 / 0.91e6 + 3.8},
      {"t805-25", 5e6, 3, 5e6 / 0.45e6 + 11.4},
      {"t800-20", 20e6, 1, 15.05},
      {"t414-20", 20e6, 0, 25},
      {"t414-20", 20e6, 1, 28.8},
      {"t414-20", 10e6, 2, 32.6},
  };
  for (const Case& c : published) {
    const Model model = machine::override_model(c.model, {{"link.bit_rate", c.bit_rate}}, "tests");
    const double bit = 1 / c.bit_rate;
    for (std::uint64_t bytes : {8, 1000, 100'000}) {
      const double start =
          static_cast<double>(cost_first(model, Side::writer, bytes)) / model.cpu.clock.value;
      EXPECT_NEAR(time_through(model, c.switches, bytes),
                  start + c.switches * 1.9 * bit + static_cast<double>(bytes) * c.byte_bits * bit,
                  1e-10)
          << fmt::format("{} at {}, {} switches, {} bytes", c.model, c.bit_rate, c.switches, bytes);
    }
  }
}

TEST(LinkSwitch, MoreOfThemAreNeverFaster) {
  for (const auto& name : machine::builtin_models())
    for (const double rate : {20e6, 10e6, 5e6}) {
      const Model model = machine::override_model(name, {{"link.bit_rate", rate}}, "tests");
      double last = 0;
      for (int switches = 0; switches < 6; ++switches) {
        const double now = time_through(model, switches, 100);
        EXPECT_GT(now, last) << name << " at " << rate << ", " << switches << " switches";
        last = now;
      }
    }
}

// DMA must take cycles only while words move, not while a switch delays the message.
TEST(LinkSwitch, DelayTakesNoCyclesFromTheCpu) {
  Model model = make_stealing_model();
  model.link.switch_bits = 1e5;
  const std::int64_t cycles = 2'000'000, words = 100;
  const auto found = isolated_numbers([&] {
    Lab lab(model);
    Processor &a = lab.cpu(), &b = lab.cpu();
    lab.machine.connect(a, b, 1);
    auto& channel = lab.hard(a, b);
    a.start("writer", Priority::high, [&] { out(channel, {4 * words}); });
    b.start("reader", Priority::high, [&] { channel.in(); });
    double end = 0;
    a.start("busy", Priority::low,
            [&] { compute(cycles), this_process().sync(), end = own_cycles(); });
    lab.machine.run();
    return Numbers{end};
  });
  EXPECT_NEAR(
      found.at(0),
      cycles + words * STEAL_WORD +
          (model.channel.blocked + model.scheduler.preemption + model.scheduler.return_to_low)
              .value,
      1e-3);
}

}  // namespace
}  // namespace occam

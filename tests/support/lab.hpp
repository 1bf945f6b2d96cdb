#pragma once
// A small machine, its models and its costs, as the tests of the machine and of occam need them.

#include <fmt/format.h>

#include <cstdlib>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "simulator/occam/alt.hpp"
#include "simulator/occam/channel.hpp"
#include "simulator/occam/process.hpp"
#include "tests/support/isolated.hpp"

namespace occam {

using Numbers = std::vector<double>;
using machine::Model;
using machine::Processor;
using test::isolated;
using test::isolated_numbers;

constexpr Priority BOTH_PRIORITIES[] = {Priority::high, Priority::low};

// A message of any length that carries a number.
struct Words {
  std::uint64_t length = 4, content = 0;
  std::uint64_t bytes() const { return length; }
};

// t805-25 without operands' loads, fetches of code and DMA's stolen cycles, and with a clock, ticks
// and links of powers of two, so that every time is a whole number of cycles and has no rounding.
inline Model derive_exact_model() {
  Model model = machine::override_model("t805-25", {{"instruction.fetch", "0"}}, "tests");
  model.memory.steal_word = 0;
  for (machine::Cycles* beside : {&model.channel.operands, &model.channel.out_word})
    *beside = {0};  // counted in tests of their own
  model.cpu.clock = {0x1p24};
  model.timer.high_tick = 0x1p-20;  // 16 cycles
  model.timer.low_tick = 0x1p-14;   // 1024 cycles
  model.scheduler.slice = {4096};
  model.link.one_way_rate = 0x1p20;  // 16 cycles a byte
  model.link.both_ways_rate = 0x1.8p20;
  return model;
}

// Read once, before any test forks: the children have copies.
inline const Model REAL_MODEL = machine::load_model("t805-25");
inline const Model EXACT_MODEL = derive_exact_model();

inline Model make_exact_model() { return EXACT_MODEL; }

inline std::int64_t words_in(std::uint64_t bytes) {
  return static_cast<std::int64_t>((bytes + 3) / 4);
}

// What the end that comes second spends on a soft channel.
inline std::int64_t soft_cost(const Model& model, std::uint64_t bytes) {
  return (model.channel.soft_setup + words_in(bytes) * model.channel.copy_word).value;
}

// This process's own time.
inline double own_cycles() {
  return this_process().now().value * this_process().processor().clock().value;
}

inline void compute(std::int64_t cycles) { this_process().charge(Cycles{cycles}); }

inline void wait_until_cycle(std::int64_t cycle) {
  wait_until(ticks(Cycles{cycle} / this_process().processor().clock()));
}

// ctest runs the tests of machine and occam three times: on SimGrid with fibers; and as the
// environment says with SimGrid's actors, and with links of our own.
inline machine::EngineParams engine_under_test() {
  const char* given = std::getenv("TLAB_TEST_ENGINE");
  const std::string_view name = given ? given : "";
  if (name == "direct") return {.links = machine::Links::direct};
  return {.processes = name == "actors" ? machine::Processes::actors : machine::Processes::fibers};
}

// And once more with Procs, where a test can do without stacks.
inline bool bodies_have_stacks() {
  const char* given = std::getenv("TLAB_TEST_BODIES");
  return std::string_view(given ? given : "") != "procs";
}

// A machine and the channels of its processes. It is built and run inside of isolated().
struct Lab {
  explicit Lab(const Model& model = make_exact_model(), machine::Code code = machine::Code::bare,
               machine::EngineParams engine = engine_under_test())
      : machine(model, code, engine) {}

  Processor& cpu() {
    return machine.add_processor(fmt::format("cpu {}", machine.processors().size()), 1 << 20);
  }
  Processor& neighbour(Processor& other) {
    Processor& added = cpu();
    machine.connect(other, added);
    return added;
  }
  Channel<Words>& soft() { return channels.emplace_back(fmt::format("soft {}", channels.size())); }
  Channel<Words>& hard(Processor& from, Processor& to) {
    auto& link = machine.link(from, to);
    return channels.emplace_back(link.name(), link);
  }
  double cycles() const { return machine.now().value * machine.model().cpu.clock.value; }
  double busy_cycles(const Processor& cpu) const {
    return cpu.use().busy().value * machine.model().cpu.clock.value;
  }

  std::deque<Channel<Words>> channels;
  machine::Machine machine;
};

enum class Side { writer, reader };

// t805-25 with everything on chip, and without the fetch of code, as the instruction tables count.
inline Model make_on_chip_model() {
  return machine::override_model(
      "t805-25", {{"memory.data_word", "\"memory.on_chip_word\""}, {"instruction.fetch", "0"}},
      "tests");
}

// The exact model, with the operands that it leaves out.
inline Model make_complete_model() {
  Model model = make_exact_model();
  model.channel.operands = REAL_MODEL.channel.operands;
  model.channel.out_word = REAL_MODEL.channel.out_word;
  return model;
}

// in or out up to the instruction itself; a message of one word is sent by outword.
inline std::int64_t cost_before(const Model& model, Side side, std::uint64_t bytes) {
  const bool is_outword = side == Side::writer && bytes == 4;
  return (model.channel.operands + (is_outword ? model.channel.out_word : Cycles{0})).value;
}
// What the end that comes first spends, or the one that starts a link.
inline std::int64_t cost_first(const Model& model, Side side, std::uint64_t bytes) {
  return cost_before(model, side, bytes) + model.channel.blocked.value;
}
// What the end that comes second on one processor spends: 2w+19, on chip.
inline std::int64_t cost_second(const Model& model, Side side, std::uint64_t bytes) {
  return cost_before(model, side, bytes) + soft_cost(model, bytes);
}

// Two cycles a word: a direction alone, at 16 cycles a byte, takes 2 / 64 = 1/32 of the CPU.
inline Model make_stealing_model() {
  Model model = make_exact_model();
  model.memory.steal_word = 2;
  return model;
}
constexpr std::int64_t STEAL_WORD = 2;

inline std::string name_of(Priority p) { return p == Priority::high ? "high" : "low"; }

constexpr double ROUNDING = 1e-4;  // cycles: of a clock that is no power of two, and of SimGrid

}  // namespace occam

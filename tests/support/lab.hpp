#pragma once
// A small machine with simple costs, for the tests of the machine and of occam.

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

// A message of `length` bytes, which carries one number.
struct Words {
  std::uint64_t length = 4, content = 0;
  std::uint64_t bytes() const { return length; }
};

// The model t805-25 without operand loads, code fetches and cycles that DMA takes from the CPU.
// Clock, timer ticks and link rates are powers of two, so that every time is a whole number of
// cycles.
inline Model derive_exact_model() {
  Model model = machine::override_model("t805-25", {{"instruction.fetch", 0.0}}, "tests");
  model.memory.steal_word = 0;
  for (machine::Cycles* beside : {&model.channel.operands, &model.channel.out_word})
    *beside = {0};  // other tests cover these costs
  model.cpu.clock = {0x1p24};
  model.timer.high_tick = 0x1p-20;  // 16 cycles
  model.timer.low_tick = 0x1p-14;   // 1024 cycles
  model.scheduler.slice = {4096};
  model.link.one_way_rate = 0x1p20;  // 16 cycles per byte
  model.link.both_ways_rate = 0x1.8p20;
  return model;
}

// Loaded before any test forks, so that child processes get copies.
inline const Model REAL_MODEL = machine::load_model("t805-25");
inline const Model EXACT_MODEL = derive_exact_model();

inline Model make_exact_model() { return EXACT_MODEL; }

inline std::int64_t words_in(std::uint64_t bytes) {
  return static_cast<std::int64_t>((bytes + 3) / 4);
}

// Cost, in cycles, of a rendezvous on a soft channel (between processes of one processor) for the
// process that arrives second.
inline std::int64_t soft_cost(const Model& model, std::uint64_t bytes) {
  return (model.channel.soft_setup + words_in(bytes) * model.channel.copy_word).value;
}

// The time of the current process, in cycles.
inline double own_cycles() {
  return this_process().now().value * this_process().processor().clock().value;
}

inline void compute(std::int64_t cycles) { this_process().charge(Cycles{cycles}); }

inline void wait_until_cycle(std::int64_t cycle) {
  wait_until(ticks(Cycles{cycle} / this_process().processor().clock()));
}

// The engine to test. ctest runs the tests of the machine and of occam with three engines: SimGrid
// with fibers, SimGrid with actors, and tlab's own engine for links. The environment variable
// TLAB_TEST_ENGINE selects the second and the third.
inline machine::EngineParams engine_under_test() {
  const char* given = std::getenv("TLAB_TEST_ENGINE");
  const std::string_view name = given ? given : "";
  if (name == "direct") return {.links = machine::Links::direct};
  return {.processes = name == "actors" ? machine::Processes::actors : machine::Processes::fibers};
}

// False if the environment variable TLAB_TEST_BODIES is "procs". ctest sets it for a fourth run of
// these tests. In this run, tests that need no stacks use Procs (coroutines without a stack) as
// processes.
inline bool bodies_have_stacks() {
  const char* given = std::getenv("TLAB_TEST_BODIES");
  return std::string_view(given ? given : "") != "procs";
}

// A machine, and the channels between its processes. Tests make and run it inside isolated().
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

// The model t805-25 with all data on chip and without code fetches, as in the instruction tables of
// the data book.
inline Model make_on_chip_model() {
  return machine::override_model(
      "t805-25", {{"memory.data_word", "memory.on_chip_word"}, {"instruction.fetch", 0.0}},
      "tests");
}

// The exact model with the costs of loading operands, which it otherwise lacks.
inline Model make_complete_model() {
  Model model = make_exact_model();
  model.channel.operands = REAL_MODEL.channel.operands;
  model.channel.out_word = REAL_MODEL.channel.out_word;
  return model;
}

// Cost, in cycles, of in or out before the instruction itself. A message of one word uses outword.
inline std::int64_t cost_before(const Model& model, Side side, std::uint64_t bytes) {
  const bool is_outword = side == Side::writer && bytes == 4;
  return (model.channel.operands + (is_outword ? model.channel.out_word : Cycles{0})).value;
}
// Cost, in cycles, for the process that arrives first at a channel, or that starts a transfer on a
// link.
inline std::int64_t cost_first(const Model& model, Side side, std::uint64_t bytes) {
  return cost_before(model, side, bytes) + model.channel.blocked.value;
}
// Cost, in cycles, for the process that arrives second at a soft channel: 2 w + 19 on chip for w
// words.
inline std::int64_t cost_second(const Model& model, Side side, std::uint64_t bytes) {
  return cost_before(model, side, bytes) + soft_cost(model, bytes);
}

// A model in which DMA takes two cycles of the CPU for each word. A link direction that transfers,
// at 16 cycles per byte, then takes 2 / 64 = 1/32 of the CPU.
inline Model make_stealing_model() {
  Model model = make_exact_model();
  model.memory.steal_word = 2;
  return model;
}
constexpr std::int64_t STEAL_WORD = 2;

inline std::string name_of(Priority p) { return p == Priority::high ? "high" : "low"; }

// tolerance in cycles, for rounding by SimGrid and for clock rates that are not powers of two
constexpr double ROUNDING = 1e-4;

}  // namespace occam

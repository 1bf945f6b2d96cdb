// Sums of the model's rows: what the operations of occam must cost.
#pragma once

#include "tests/support/support.hpp"

namespace occam {

enum class Side { writer, reader };

// t805-25 with everything on chip, as the instruction tables count.
inline Model make_on_chip_model() {
  return machine::override_model("t805-25", {{"memory.data_word", "\"memory.on_chip_word\""}},
                                 "tests");
}

// The exact model, with the operands that it leaves out.
inline Model make_complete_model() {
  Model model = make_exact_model();
  const Model real = machine::load_model("t805-25");
  model.channel.operands = real.channel.operands;
  model.channel.out_word = real.channel.out_word;
  return model;
}

// in or out up to the instruction itself; a message of one word is sent by outword.
inline std::int64_t cost_before(const Model& model, Side side, std::uint64_t bytes) {
  const bool is_outword = side == Side::writer && bytes == 4;
  return (model.channel.operands + (is_outword ? model.channel.out_word : Cycles{0})).value;
}
// Of the end that comes first, or that starts a link.
inline std::int64_t cost_first(const Model& model, Side side, std::uint64_t bytes) {
  return cost_before(model, side, bytes) + model.channel.blocked.value;
}
// Of the end that comes second on one processor: 2w+19, on chip.
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

// Machines with links that are cut.
#pragma once

#include "tests/support/lab.hpp"

namespace occam {

inline machine::Seconds at_cycle(const Lab& lab, double cycle) {
  return {cycle / lab.machine.model().cpu.clock.value};
}

// Two processors joined by a link that is cut at `cycle`.
struct CutPair {
  CutPair(double cycle, const Model& model = make_exact_model(), int switches = 0) : lab(model) {
    lab.machine.connect(a, b, switches);
    lab.machine.cut_link(a, b, at_cycle(lab, cycle));
  }
  Lab lab;
  Processor& a = lab.cpu();
  Processor& b = lab.cpu();
};

// A process that outputs or inputs one message. Its results are `moved` (1 if the message was
// moved, otherwise 0) and `end`, the cycle of its end.
struct Attempt {
  Processor& on;
  Priority priority;
  Side side;
  Channel<Words>& channel;
  std::int64_t computes = 0;
  std::uint64_t bytes = 8;
  double moved = -1, end = -1;

  void start() {
    const auto name = side == Side::writer ? "writer" : "reader";
    if (bodies_have_stacks())
      on.start(name, priority, [this] { with_stack(); });
    else
      on.start(name, priority, without());
  }
  void with_stack() {
    compute(computes);
    moved = side == Side::writer ? out_or_fail(channel, {bytes}) : in_or_fail(channel).has_value();
    this_process().sync();
    end = own_cycles();
  }
  Proc without() {
    compute(computes);
    if (side == Side::writer)
      moved = co_await channel.output_or_fail({bytes});
    else
      moved = (co_await channel.input_or_fail()).has_value();
    co_await machine::Sync();
    end = own_cycles();
  }
};

}  // namespace occam

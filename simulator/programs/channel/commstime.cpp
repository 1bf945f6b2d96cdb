// Commstime, a benchmark of context switches and soft channels on one transputer.
//
//            .------- a -------.
//            v                 |
//         prefix --- b ---> delta --- d ---> consume
//            ^                 |
//            '- succ <--- c ---'            (a: succ to prefix)
//
// In addition to channels, the program charges the other instructions of the compiled occam
// program: the jump back of a WHILE, an iteration of a replicated SEQ, and an addition.
#include "simulator/programs/declare/support.hpp"

namespace programs {

namespace commstime {

struct Number {
  std::int64_t value = 0;
  static constexpr std::uint64_t bytes() { return 4; }
};
using Wire = Channel<Number>;

void turn() {
  occam::charge("j");
  occam::charge("prefix");
}

void prefix(Wire& in, Wire& out, std::int64_t loops) {
  Number n;
  for (std::int64_t i = 0; i < loops; ++i) {
    out.out(n);
    n = in.in();
    turn();
  }
}

void delta(Wire& from, Wire& left, Wire& right, std::int64_t loops) {
  Number n;
  for (std::int64_t i = 0; i < loops; ++i) {
    in(from, n);
    occam::par({{"delta.left", Priority::low, [&] { out(left, n); }},
                {"delta.right", Priority::low, [&] { out(right, n); }}});
    turn();
  }
}

void successor(Wire& from, Wire& to, std::int64_t loops) {
  Number n;
  for (std::int64_t i = 0; i < loops; ++i) {
    in(from, n);
    occam::charge("ldc");  // stands for the instruction adc (addition), which takes as long
    ++n.value;
    out(to, n);
    turn();
  }
}

void consume(Wire& from, std::int64_t loops) {
  for (std::int64_t i = 0; i < loops; ++i) {
    from.in();
    for (const char* instruction : {"ldlp", "ldc", "prefix", "lend"}) occam::charge(instruction);
  }
}

struct Params {
  std::int64_t loops = 1000;
};

struct Measured {
  double loop_us = 0, loop_cycles = 0;
};

Outcome<Measured> run(const Setup& setup, const Params& params) {
  const auto loops = params.loops;
  Machine machine(setup, 1);
  auto& processor = machine[0];
  Wire a("a"), b("b"), c("c"), d("d");
  processor.start("prefix", Priority::low, [&] { prefix(a, b, loops); });
  processor.start("delta", Priority::low, [&] { delta(b, c, d, loops); });
  processor.start("successor", Priority::low, [&] { successor(c, a, loops); });
  processor.start("consume", Priority::low, [&] { consume(d, loops); });
  run_machine(setup, machine);
  const double loop_s = machine.now().value / static_cast<double>(loops);
  return Measured{loop_s * 1e6, loop_s * setup.model.cpu.clock.value};
}

}  // namespace commstime

Program make_commstime() {
  using namespace commstime;
  return make_program<Params, Measured>(
      {.name = "commstime",
       .help = "the Commstime benchmark on one processor",
       .fields = {base::Declare<Params>::whole("loops", &Params::loops, 1, 1e9, "",
                                               "iterations of the loop")},
       .columns = {column("loop_us", &Measured::loop_us, "time of an iteration"),
                   column("loop_cycles", &Measured::loop_cycles, "time of an iteration")},
       .run = &run});
}

}  // namespace programs

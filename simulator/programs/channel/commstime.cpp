// Commstime, the benchmark of context switches and soft channels on one transputer.
//
//            .------- a -------.
//            v                 |
//         prefix --- b ---> delta --- d ---> consume
//            ^                 |
//            '- succ <--- c ---'            (a: succ to prefix)
//
// What compiled occam does around its channels is charged by instruction: the jump back of a WHILE,
// the turn of a replicated SEQ, an addition.
#include "simulator/declare/support.hpp"

namespace programs {

namespace {

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
    occam::charge("ldc");  // adc
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

Row run(const Setup& setup) {
  const auto loops = setup.whole("loops");
  machine::Machine machine(setup.model);
  add_processors(machine, 1);
  auto& processor = *machine.processors()[0];
  Wire a("a"), b("b"), c("c"), d("d");
  processor.start("prefix", Priority::low, [&] { prefix(a, b, loops); });
  processor.start("delta", Priority::low, [&] { delta(b, c, d, loops); });
  processor.start("successor", Priority::low, [&] { successor(c, a, loops); });
  processor.start("consume", Priority::low, [&] { consume(d, loops); });
  run_machine(setup, machine);
  const double loop_s = machine.now().value / static_cast<double>(loops);
  return {{"loop_us", loop_s * 1e6}, {"loop_cycles", loop_s * setup.model.cpu.clock.value}};
}

}  // namespace

Pattern make_commstime() {
  return {"commstime",
          "the Commstime benchmark on one processor: loop_us",
          false,
          {{"loops", 1000, 1, 1e9, true, "of the cycle of processes"}},
          &run};
}

}  // namespace programs

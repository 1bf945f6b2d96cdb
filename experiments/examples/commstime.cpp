// Commstime, a classical benchmark of occam systems (P. Welch, University of Kent), measures the
// cost of channels, PAR and process switches. The published time for a T800-20 is 15.049 us a loop.
//
//            +--------+    a    +-------+    d    +---------+
//        +-->| prefix |-------->| delta |-------->| consume |
//        |   +--------+         +-------+         +---------+
//      b |                          | c
//        |        +------+          |
//        +--------| succ |<---------+         all at low priority on one T800-20
//                 +------+
//
// A number circulates and grows by 1 in each loop, and consume receives each value. One loop takes
// 303 cycles at 20 MHz:
//   204  4 channels: operands 4 + 4, wait of one process 20, copy by the other 21, outword 2
//    53  one PAR: preparation of two branches 15, startp 12, two endp 26
//    25  end of each loop: 3 WHILE (j 3, prefix 1), 1 SEQ (ldlp 1, ldc 1, prefix 1, lend 10)
//     1  adc, which increments the number
//    20  code fetches of 2 cycles: after 4 waits, 2 endp, 3 jumps, 1 lend
#include <fmt/format.h>

#include "simulator/occam/channel.hpp"
#include "simulator/occam/process.hpp"

using namespace occam;
using machine::Model;

namespace {

constexpr int LOOPS = 1000;
constexpr double PUBLISHED_US = 15.049;

struct Int {
  int value = 0;
  static constexpr std::uint64_t bytes() { return 4; }
};
using Ints = Channel<Int>;

// The instructions that repeat a loop: a jump for WHILE TRUE, and lend for SEQ i = 0 FOR n.
void again() {
  for (auto instruction : {"prefix", "j"}) charge(instruction);
}
void next() {
  for (auto instruction : {"ldlp", "ldc", "prefix", "lend"}) charge(instruction);
}

// This process is a coroutine, which needs no stack. The others have the usual form of a function.
Proc prefix(Ints& b, Ints& a) {
  co_await a.output(Int{0});
  for (;; again()) co_await a.output(co_await b.input());
}

void delta(Ints& a, Ints& c, Ints& d) {
  for (Int x;; again()) {
    in(a, x);
    par({{"delta.c", Priority::low, [&] { out(c, x); }},
         {"delta.d", Priority::low, [&] { out(d, x); }}});
  }
}

void succ(Ints& c, Ints& b) {
  for (Int x;; again()) {
    in(c, x);
    // charges ldc instead of adc, which takes as long; `out` charges the loads of x and b's address
    charge("ldc");
    out(b, Int{x.value + 1});
  }
}

// Repeatedly measures the mean time of a thousand loops. Reading the simulator's clock costs no
// simulated time.
void consume(Ints& d, Seconds& loop) {
  for (Int x;;) {
    const Seconds start = this_process().now();
    for (int i = 0; i < LOOPS; ++i, next()) in(d, x);
    loop = (1.0 / LOOPS) * (this_process().now() - start);
  }
}

}  // namespace

int main() {
  const Model model = machine::override_model(
      "t800-20",
      {{"memory.data_word", "memory.on_chip_word"}, {"memory.code_word", "memory.on_chip_word"}},
      "commstime");
  machine::Machine machine(model);
  auto& t800 = machine.add_processor("t800", 4096);
  Ints a("a"), b("b"), c("c"), d("d");
  Seconds loop{};
  t800.start("prefix", Priority::low, prefix(b, a));
  t800.start("delta", Priority::low, [&] { delta(a, c, d); });
  t800.start("succ", Priority::low, [&] { succ(c, b); });
  t800.start("consume", Priority::low, [&] { consume(d, loop); });
  machine.run({0.1});  // time limit in seconds, because the program never ends by itself

  const double us = 1e6 * loop.value;
  fmt::print("a loop: {:.3f} us, {:.0f} cycles\n", us, loop.value * model.cpu.clock.value);
  fmt::print("published: {:.3f} us, {:+.1f} %\n", PUBLISHED_US, 100 * (us / PUBLISHED_US - 1));
}

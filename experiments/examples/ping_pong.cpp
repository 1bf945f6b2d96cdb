// Ping-pong: the time of a message from one processor to its neighbour.
//
//        +------+   there    +------+
//        | ping |----------->| pong |
//        |      |<-----------|      |        two T805-25, one link
//        +------+    back    +------+
//
// The receiver already waits for each message. One way therefore takes the time of the
// instructions that start an output, (operands + blocked) / clock, plus the time on the wire,
// bytes / one-way rate. A message of one word uses outword, which takes 2 more cycles:
//   (28 + 2) / 25 MHz + 4 / 1.778 MB/s = 1.2 us + 2.25 us = 3.45 us
#include <fmt/format.h>

#include "simulator/occam/channel.hpp"
#include "simulator/occam/process.hpp"

using namespace occam;
using machine::Machine;
using machine::Model;

namespace {

constexpr std::uint64_t LENGTHS[] = {1, 4, 16, 64, 256, 1024, 4096, 16384, 65536};

struct Block {
  std::uint64_t length = 0;
  std::uint64_t bytes() const { return length; }
};

void ping(Channel<Block>& there, Channel<Block>& back, const Model& model) {
  for (const std::uint64_t length : LENGTHS) {
    Block block{length};
    out(there, block);  // not measured; from now on, pong already waits
    in(back, block);
    const Seconds start = this_process().now();
    out(there, block);
    in(back, block);
    const Seconds one_way = 0.5 * (this_process().now() - start);

    const Cycles outword = length == 4 ? model.channel.out_word : Cycles{0};
    const Cycles cycles = model.channel.operands + model.channel.blocked + outword;
    const double wire = static_cast<double>(length) / model.link.one_way_rate;
    fmt::print("{:7} {:12.2f} {:12.2f} {:8.3f}\n", length, 1e6 * one_way.value,
               1e6 * ((cycles / model.cpu.clock).value + wire),
               1e-6 * static_cast<double>(length) / one_way.value);
  }
  out(there, Block{0});
}

void pong(Channel<Block>& there, Channel<Block>& back) {
  for (Block block;;) {
    in(there, block);
    if (block.length == 0) break;
    out(back, block);
  }
}

}  // namespace

int main() {
  Machine machine(machine::load_model("t805-25"));
  auto& left = machine.add_processor("left", 1 << 20);
  auto& right = machine.add_processor("right", 1 << 20);
  machine.connect(left, right);
  Channel<Block> there("there", machine.link(left, right));
  Channel<Block> back("back", machine.link(right, left));
  fmt::print("{:>7} {:>12} {:>12} {:>8}\n", "bytes", "one way, us", "formula, us", "MB/s");
  left.start("ping", Priority::high, [&] { ping(there, back, machine.model()); });
  right.start("pong", Priority::high, [&] { pong(there, back); });
  machine.run();
}

#include <malloc.h>

#include "simulator/network/store_and_forward.hpp"
#include "simulator/occam/process.hpp"
#include "tests/benchmarks/machine.hpp"
#include "tests/benchmarks/traffic.hpp"
#include "topologies/graph/topology.hpp"
#include "topologies/make/generators.hpp"

namespace benchmarks {

using machine::Machine;
using machine::Priority;
using network::Packet;
using network::StoreAndForward;
using occam::Channel;
using occam::Signal;

namespace {

constexpr int ROUNDS = 20;
constexpr machine::Cycles WORK{2000};  // of a round

// A processor's three processes beside its router: in every round one sends to all neighbours,
// one receives as much from them, and one computes with it.
struct Exchange {
  Channel<Signal> computed{"computed"}, received{"received"};

  void source(StoreAndForward& network, int id, const std::vector<topologies::Neighbour>& around) {
    for (int round = 0; round < ROUNDS; ++round) {
      if (round > 0) in(computed);
      for (const auto& neighbour : around)
        out(network.into(id), {Packet{id, neighbour.processor, MESSAGE_BYTES}});
    }
  }
  void sink(StoreAndForward& network, int id, std::size_t neighbours) {
    for (int round = 0; round < ROUNDS; ++round) {
      for (std::size_t i = 0; i < neighbours; ++i) network.delivered(id).in();
      out(received, Signal{});
    }
  }
  void compute() {
    for (int round = 1; round <= ROUNDS; ++round) {
      in(received);
      occam::this_process().charge(WORK);
      if (round < ROUNDS) out(computed, Signal{});
    }
  }
};

// Memory is of all there is to a machine: what is built, and what has grown when it has run.
Sample exchange(int side, machine::EngineParams engine) {
  // As in a process that has allocated nothing yet: what the parent freed would not be counted.
  malloc_trim(0);
  mallopt(M_MMAP_THRESHOLD, 128 * 1024);
  const double before_kb = memory_kb();
  const auto topology = topologies::make_topology(fmt::format("mesh:{0}x{0}", side));
  const auto around = topologies::neighbours(topology);
  Machine machine(model(), machine::Code::bare, engine);
  for (int id = 0; id < topology.processors; ++id)
    machine.add_processor(fmt::format("p{}", id), PROCESSOR_MEMORY);
  StoreAndForward network(machine, topology);
  std::deque<Exchange> exchanges(static_cast<std::size_t>(topology.processors));
  std::size_t hops = 0;
  for (int id = 0; id < topology.processors; ++id) {
    auto& processor = *machine.processors()[id];
    auto& own = exchanges[static_cast<std::size_t>(id)];
    const auto& neighbours = around[static_cast<std::size_t>(id)];
    processor.start("source", Priority::high, [&, id] { own.source(network, id, neighbours); });
    processor.start("sink", Priority::high, [&, id] { own.sink(network, id, neighbours.size()); });
    processor.start("compute", Priority::low, [&] { own.compute(); });
    hops += ROUNDS * neighbours.size();
  }
  Sample sample = run(machine, hops);
  sample.memory_kb = memory_kb() - before_kb;
  return sample;
}

}  // namespace

void add_neighbours() {
  for (const Engine& engine : ENGINES)
    for (const int side : {8, 16, 32, 128}) {
      if (side > 32 && engine.params.links == machine::Links::simgrid) continue;  // for minutes
      if (engine.params.processes == machine::Processes::actors) continue;
      add(fmt::format("neighbours of a {0} x {0} mesh", side), engine.by,
          [side, engine](benchmark::State& state) {
            const Sample sample = in_child([&] { return exchange(side, engine.params); });
            state.counters["KB_per_transputer"] = sample.memory_kb / (side * side);
            return sample;
          });
    }
}

}  // namespace benchmarks

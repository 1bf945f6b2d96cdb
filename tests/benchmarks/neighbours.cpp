#include <malloc.h>

#include "simulator/network/store_and_forward.hpp"
#include "simulator/occam/process.hpp"
#include "tests/benchmarks/machine.hpp"
#include "tests/benchmarks/traffic.hpp"
#include "topologies/graph/partition.hpp"
#include "topologies/graph/topology.hpp"
#include "topologies/make/generators.hpp"

namespace benchmarks {

using machine::Machine;
using machine::Priority;
using network::Packet;
using network::StoreAndForward;
using occam::Channel;
using occam::Proc;
using occam::Signal;

namespace {

constexpr int ROUNDS = 20;
constexpr int USUAL_WORK = 2000;  // cycles of computation in each round

// The three processes of a processor besides its router. In each round, one process sends a message
// to each neighbour, one receives as many messages, and one computes.
struct Exchange {
  explicit Exchange(machine::Cycles work) : work(work) {}
  machine::Cycles work;
  Channel<Signal> computed{"computed"}, received{"received"};

  Proc source(StoreAndForward& network, int id, const std::vector<topologies::Neighbour>& around) {
    for (int round = 0; round < ROUNDS; ++round) {
      if (round > 0) co_await computed.input();
      for (const auto& neighbour : around)
        co_await network.into(id).output({Packet{id, neighbour.processor, MESSAGE_BYTES}});
    }
  }
  Proc sink(StoreAndForward& network, int id, std::size_t neighbours) {
    for (int round = 0; round < ROUNDS; ++round) {
      for (std::size_t i = 0; i < neighbours; ++i) co_await network.delivered(id).input();
      co_await received.output({});
    }
  }
  Proc compute() {
    for (int round = 1; round <= ROUNDS; ++round) {
      co_await received.input();
      occam::this_process().charge(work);
      if (round < ROUNDS) co_await computed.output({});
    }
  }
};

// Measures elapsed time if `threads` host threads simulate the machine, or CPU time of one thread
// if `threads` is 0. The measured memory is that of making and running the machine.
Sample exchange(int side, int work, machine::EngineParams engine, int threads = 0) {
  // Returns freed memory to the system. Otherwise the machine would use memory that the parent
  // process has freed, which would not be counted.
  malloc_trim(0);
  mallopt(M_MMAP_THRESHOLD, 128 * 1024);
  const double before_kb = memory_kb();
  const auto topology = topologies::make_topology(fmt::format("mesh:{0}x{0}", side));
  const auto around = topologies::neighbours(topology);
  if (threads > 1) engine.parts = topologies::make_partition(topology, threads);
  Machine machine(model(), machine::Code::bare, engine);
  for (int id = 0; id < topology.processors; ++id)
    machine.add_processor(fmt::format("p{}", id), PROCESSOR_MEMORY);
  StoreAndForward network(machine, topology);
  std::deque<Exchange> exchanges;
  std::size_t hops = 0;
  for (int id = 0; id < topology.processors; ++id) {
    auto& processor = *machine.processors()[id];
    auto& own = exchanges.emplace_back(machine::Cycles{work});
    const auto& neighbours = around[static_cast<std::size_t>(id)];
    processor.start("source", Priority::high, own.source(network, id, neighbours));
    processor.start("sink", Priority::high, own.sink(network, id, neighbours.size()));
    processor.start("compute", Priority::low, own.compute());
    hops += ROUNDS * neighbours.size();
  }
  Sample sample =
      threads > 0 ? Sample{hops, wall_time_of([&] { machine.run(); })} : run(machine, hops);
  sample.memory_kb = memory_kb() - before_kb;
  sample.events = machine.events();
  sample.windows = machine.windows().all;
  sample.events_between = machine.windows().at_links;
  return sample;
}

}  // namespace

void add_threads() {
  for (const int side : {8, 16, 32, 64, 128})
    for (const int threads : {1, 2})
      add(fmt::format("neighbours of a {0} x {0} mesh, two threads", side),
          threads == 1 ? "one thread" : "tlab", [=](benchmark::State& state) {
            const Sample sample = in_child([&] {
              return exchange(side, USUAL_WORK, {.links = machine::Links::direct}, threads);
            });
            state.counters["windows"] = static_cast<double>(sample.windows);
            state.counters["events"] = static_cast<double>(sample.events);
            state.counters["events_between"] = static_cast<double>(sample.events_between);
            return sample;
          });
}

void add_neighbours() {
  const auto add_one = [](const Engine& engine, int side, int work) {
    const auto what = fmt::format("neighbours of a {0} x {0} mesh, {1} cycles", side, work);
    return add(what, engine.by, [=](benchmark::State& state) {
      const Sample sample = in_child([&] { return exchange(side, work, engine.params); });
      state.counters["KB_per_transputer"] = sample.memory_kb / (side * side);
      state.counters["ns_per_event"] = 1e9 * sample.cpu_s / static_cast<double>(sample.events);
      return sample;
    });
  };
  for (const Engine& engine : ENGINES) {
    if (engine.params.processes == machine::Processes::actors) continue;
    const bool is_direct = engine.params.links == machine::Links::direct;
    for (const int side : {4, 8, 16, 32, 64, 128, 256}) {
      // large meshes on SimGrid would take minutes
      if (side > 32 && !is_direct) continue;
      auto* one = add_one(engine, side, USUAL_WORK);
      if (side > 64) one->Repetitions(1);  // runs once, because five repetitions would take minutes
    }
    for (const int work : {200, 20'000, 200'000})
      if (is_direct) add_one(engine, 16, work);
  }
}

}  // namespace benchmarks

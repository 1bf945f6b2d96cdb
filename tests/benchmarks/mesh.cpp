#include "simulator/network/store_and_forward.hpp"
#include "tests/benchmarks/machine.hpp"
#include "tests/benchmarks/raw_simgrid.hpp"
#include "topologies/graph/topology.hpp"
#include "topologies/make/generators.hpp"

namespace benchmarks {

using machine::Machine;
using machine::Priority;

namespace {

occam::Proc source(network::StoreAndForward& network, int id,
                   const std::vector<int>& destinations) {
  for (const int to : destinations) co_await network.into(id).output({{id, to, MESSAGE_BYTES}});
}

occam::Proc sink(network::StoreAndForward& network, int id, int messages) {
  for (; messages > 0; --messages) co_await network.delivered(id).input();
}

// Simulates the general router. Each processor has a process that sends and a process that
// receives.
Sample mesh(const Traffic& traffic, machine::EngineParams engine) {
  Machine machine(model(), machine::Code::bare, engine);
  for (int id = 0; id < NODES; ++id)
    machine.add_processor(fmt::format("p{}", id), PROCESSOR_MEMORY);
  network::StoreAndForward network(machine,
                                   topologies::make_topology(fmt::format("mesh:{0}x{0}", SIDE)));
  for (int id = 0; id < NODES; ++id) {
    auto& processor = *machine.processors()[id];
    processor.start("source", Priority::high, source(network, id, traffic.destinations[id]));
    processor.start("sink", Priority::high, sink(network, id, traffic.arriving[id]));
  }
  return run(machine, traffic.hops);
}

}  // namespace

void add_mesh() {
  static const Traffic traffic = make_traffic();
  add_on_all("hops of 80 bytes, 8 x 8 mesh",
             [](machine::EngineParams engine) { return mesh(traffic, engine); });
  add_simulation("hops of 80 bytes, 8 x 8 mesh", "simgrid",
                 [] { return raw_mesh(model(), traffic); });
}

}  // namespace benchmarks

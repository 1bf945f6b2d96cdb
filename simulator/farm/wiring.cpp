#include "simulator/farm/wiring.hpp"

#include <numeric>

#include "simulator/farm/farm.hpp"
#include "simulator/farm/worker.hpp"
#include "simulator/network/join.hpp"
#include "topologies/route/routes.hpp"

namespace farm {

using machine::Machine;
using machine::Priority;
using machine::Processor;

namespace {

template <class Message>
Channel<Message>& soft(std::deque<Channel<Message>>& pool, const Processor& on, const char* name) {
  return pool.emplace_back(fmt::format("{}.{}", on.name(), name));
}

// Makes a channel on the link between two processors.
template <class Message>
Channel<Message>* hard(std::deque<Channel<Message>>& pool, Machine& machine, Processor& from,
                       Processor& to, const char* name) {
  return &pool.emplace_back(fmt::format("{}.{}", to.name(), name), machine.link(from, to));
}

}  // namespace

topologies::Topology free_root_port(topologies::Topology topology) {
  const auto all = topologies::neighbours(topology)[topology.root];
  if (topologies::free_port(topology, topology.root) >= 0) return topology;
  // Tries the links of the root from the last to the first. Links that have a parallel link are
  // moved to the end, because removing one of them never separates processors.
  auto around = all;
  std::ranges::stable_partition(around, [&](const auto& n) {
    return std::ranges::count(all, n.processor, &topologies::Neighbour::processor) == 1;
  });
  for (auto n = around.rbegin(); n != around.rend(); ++n) {
    topologies::Topology opened = topology;
    opened.links.erase(opened.links.begin() + n->link);
    try {
      topologies::check(opened);
      return opened;
    } catch (const base::BadInput&) {
    }
  }
  throw base::BadInput(
      fmt::format("topology {}: the root uses all four ports, and removing any link disconnects "
                  "the network: found no port for the coordinator",
                  topology.name));
}

Way start_sender(Wires& wires, Processor& on, Channel<Task>& destination) {
  Way way{soft(wires.signals, on, "from.sender"), soft(wires.tasks, on, "into.sender")};
  kernels::start(on, "sender", Priority::high,
                 [way, &destination] { sender(way.free, way.into, destination); });
  return way;
}

Workers wire_workers(Wires& wires, Machine& machine, Processor& coordinator, const Setup& setup,
                     const Params& params) {
  const auto topology = free_root_port(setup.topology);
  const auto tree = topologies::make_spanning_tree(topology, topology.root);
  Workers workers;
  workers.topology = topology;
  workers.root = static_cast<std::size_t>(topology.root);
  workers.mean_depth = 1 + std::accumulate(tree.depth.begin(), tree.depth.end(), 0.0) /
                               static_cast<double>(topology.processors);
  workers.children = tree.children;
  for (int id = 0; id < topology.processors; ++id)
    workers.processors.push_back(&add_worker(machine, topology, id, setup, params));
  machine.connect(coordinator, *workers.processors[workers.root]);
  network::join(
      machine, topology, [&](int id) -> auto& { return *workers.processors[id]; });
  for (int id = 0; id < topology.processors; ++id) {
    Processor& self = *workers.processors[id];
    Processor& parent = tree.parent[id] < 0 ? coordinator : *workers.processors[tree.parent[id]];
    workers.from_left.push_back(hard(wires.tasks, machine, parent, self, "from.left"));
    workers.results.push_back(
        hard(wires.results, machine, self, parent, (self.name() + ".results").c_str()));
  }
  return workers;
}

void start_worker(Wires& wires, const Workers& workers, std::size_t id, Kernel& kernel) {
  Processor& self = *workers.processors[id];
  auto& to_application = soft(wires.tasks, self, "application.in");
  auto& from_application = soft(wires.results, self, "application.out");
  std::vector<Channel<Signal>*> from_sender;
  std::vector<Channel<Task>*> into_sender;
  std::vector<Channel<Answer>*> inputs{&from_application};
  auto add_way = [&](Channel<Task>& destination) {
    const Way way = start_sender(wires, self, destination);
    from_sender.push_back(&way.free);
    into_sender.push_back(&way.into);
  };
  add_way(to_application);
  for (int child : workers.children[id]) {
    add_way(*workers.from_left[child]);
    inputs.push_back(workers.results[child]);
  }
  auto& from_left = *workers.from_left[id];
  auto& results = *workers.results[id];
  kernels::start(self, "data.router", Priority::high, [&from_left, from_sender, into_sender] {
    data_router(from_left, from_sender, into_sender);
  });
  kernels::start(self, "results.router", Priority::high,
                 [inputs, &results] { results_router(inputs, results); });
  kernels::start(self, "application", Priority::low, [&kernel, &to_application, &from_application] {
    application(kernel, to_application, from_application);
  });
}

}  // namespace farm

// A program of one's own: a barrier over a tree. Each processor reports to its parent when all
// processors below it have arrived. When all have arrived, the root lets them go.
#include "simulator/programs/declare/support.hpp"
#include "topologies/route/routes.hpp"

namespace programs {

namespace {

struct Params {
  int rounds = 10;
};

struct Measured {
  double barrier_s = 0;
  int depth = 0;
};

using occam::Signal;

// The link between a processor and its parent, with a channel in each direction.
struct Way {
  Way(machine::Machine& machine, machine::Processor& parent, machine::Processor& child)
      : up(child.name() + ".up", machine.link(child, parent)),
        down(child.name() + ".down", machine.link(parent, child)) {}
  Channel<Signal> up, down;
};

// One round on a processor: waits until its children have arrived, reports to the parent, waits
// until it may go, and lets the children go.
void pass_barrier(Way* parent, const std::vector<Way*>& children) {
  for (Way* child : children) in(child->up);
  if (parent) {
    out(parent->up, Signal{});
    in(parent->down);
  }
  for (Way* child : children) out(child->down, Signal{});
}

Outcome<Measured> run(const Setup& setup, const Params& params) {
  const auto tree = topologies::make_spanning_tree(setup.topology, setup.topology.root);
  Machine machine(setup, setup.topology.processors);
  std::deque<Way> ways;
  std::vector<Way*> parent(tree.parent.size());
  std::vector<std::vector<Way*>> children(tree.parent.size());
  for (int id = 0; id < setup.topology.processors; ++id)
    for (const int child : tree.children[id]) {
      machine.connect(machine[id], machine[child], switches_between(setup.topology, id, child));
      parent[child] = &ways.emplace_back(machine, machine[id], machine[child]);
      children[id].push_back(parent[child]);
    }
  Seconds last;
  for (int id = 0; id < setup.topology.processors; ++id)
    machine[id].start("node", Priority::high, [&, id] {
      wait_for_start();
      for (int round = 0; round < params.rounds; ++round) pass_barrier(parent[id], children[id]);
      last = std::max(last, now());
    });
  run_machine(setup, machine);
  return Measured{(last - START).value / params.rounds, std::ranges::max(tree.depth)};
}

}  // namespace

Program make_barrier() {
  using D = base::Declare<Params>;
  return make_program<Params, Measured>(
      {.name = "barrier",
       .help = "a barrier of all processors along the spanning tree",
       .uses = {.network = true},
       .fields = {D::whole("rounds", &Params::rounds, 1, 1e6, "", "barriers, one after the other")},
       .columns = {column("barrier_s", &Measured::barrier_s, "time of a round"),
                   column("depth", &Measured::depth, "links from the root to a leaf")},
       .run = &run});
}

}  // namespace programs

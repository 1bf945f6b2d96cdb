// Broadcast of a message from the root along the spanning tree. Each processor forwards the message
// to its children, either in parallel (PAR) or one after another (SEQ).
#include "simulator/programs/declare/support.hpp"

namespace programs {

namespace broadcast {

using Channels = std::vector<Channel<Message>*>;

void pass_on(const Message& message, const Channels& children, bool in_parallel) {
  if (children.empty()) return;
  if (!in_parallel) {
    for (auto* child : children) out(*child, message);
    return;
  }
  std::vector<occam::Branch> branches;
  for (auto* child : children)
    branches.push_back({"to.child", Priority::high, [child, message] { out(*child, message); }});
  occam::par(branches);
}

struct Params {
  std::uint64_t bytes = 100;
  bool in_parallel = true;
};

struct Measured {
  Seconds latency;
  int depth = 0;
  std::size_t fan_out = 0;
};

Outcome<Measured> run(const Setup& setup, const Params& params) {
  const auto tree = topologies::make_spanning_tree(setup.topology, setup.topology.root);
  Machine machine(setup, setup.topology.processors);
  std::deque<Channel<Message>> channels;
  std::vector<Channel<Message>*> from_parent(tree.parent.size());
  std::vector<Channels> to_children(tree.parent.size());
  std::size_t fan_out = 0;
  for (std::size_t id = 0; id < tree.parent.size(); ++id)
    for (int child : tree.children[id]) {
      auto &here = machine[id], &there = machine[child];
      machine.connect(here, there, switches_between(setup.topology, static_cast<int>(id), child));
      auto& channel = channels.emplace_back(there.name() + ".in", machine.link(here, there));
      from_parent[child] = &channel;
      to_children[id].push_back(&channel);
      fan_out = std::max(fan_out, tree.children[id].size());
    }
  std::vector<Seconds> has_it(tree.parent.size());
  for (std::size_t id = 0; id < tree.parent.size(); ++id)
    machine[id].start("node", Priority::high, [&, id] {
      Message message = Message{params.bytes};
      if (from_parent[id])
        in(*from_parent[id], message);
      else
        wait_for_start();
      has_it[id] = now();
      pass_on(message, to_children[id], params.in_parallel);
    });
  run_machine(setup, machine);
  return Measured{std::ranges::max(has_it) - START, std::ranges::max(tree.depth), fan_out};
}

}  // namespace broadcast

Program make_broadcast() {
  using namespace broadcast;
  return make_program<Params, Measured>(
      {.name = "broadcast",
       .help = "a message from the root to all processors along the spanning tree",
       .uses = {.network = true, .others = true, .threads = true},
       .fields = {bytes_field<Params>(&Params::bytes),
                  base::Declare<Params>::flag(
                      "in_parallel", &Params::in_parallel,
                      "true: a processor outputs to its children in PAR; false: in SEQ")},
       .columns = {column("latency_s", &Measured::latency,
                          "time until the last processor has the message"),
                   column("depth", &Measured::depth, "links from the root to the last leaf"),
                   column("fan_out", &Measured::fan_out,
                          "largest number of children of a processor in the tree")},
       .run = &run});
}

}  // namespace programs

// A message from the root to all, along the spanning tree: each processor passes it on to its
// children, all at once (PAR) or one after the other (SEQ).
#include "simulator/declare/support.hpp"
#include "topologies/route/routes.hpp"

namespace programs {

namespace {

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

Row run(const Setup& setup) {
  const auto tree = topologies::make_spanning_tree(setup.topology, setup.topology.root);
  const bool in_parallel = setup["in_parallel"] != 0;
  machine::Machine machine(setup.model);
  add_processors(machine, setup.topology.processors);
  std::deque<Channel<Message>> channels;
  std::vector<Channel<Message>*> from_parent(tree.parent.size());
  std::vector<Channels> to_children(tree.parent.size());
  std::size_t fan_out = 0;
  for (std::size_t id = 0; id < tree.parent.size(); ++id)
    for (int child : tree.children[id]) {
      auto &here = *machine.processors()[id], &there = *machine.processors()[child];
      machine.connect(here, there, switches_between(setup.topology, static_cast<int>(id), child));
      auto& channel = channels.emplace_back(there.name() + ".in", machine.link(here, there));
      from_parent[child] = &channel;
      to_children[id].push_back(&channel);
      fan_out = std::max(fan_out, tree.children[id].size());
    }
  Seconds last;
  for (std::size_t id = 0; id < tree.parent.size(); ++id)
    machine.processors()[id]->start("node", Priority::high, [&, id] {
      Message message = make_message_of(setup);
      if (from_parent[id])
        in(*from_parent[id], message);
      else
        wait_for_start();
      last = std::max(last, now());
      pass_on(message, to_children[id], in_parallel);
    });
  run_machine(setup, machine);
  return {{"latency_s", (last - START).value},
          {"depth", std::ranges::max(tree.depth)},
          {"fan_out", static_cast<double>(fan_out)}};
}

}  // namespace

Pattern make_broadcast() {
  return {"broadcast",
          "a message from the root to all along the spanning tree: latency_s, of the last to have "
          "it; the tree's depth and fan_out",
          true,
          {bytes_parameter(1),
           {"in_parallel", 1, 0, 1, true, "to the children in PAR, 1, or in SEQ, 0"}},
          &run};
}

}  // namespace programs

#include "simulator/network/network.hpp"

#include "simulator/network/join.hpp"
#include "simulator/network/routers.hpp"

namespace network {

void Client::send(Message message) {
  base::check_equal("a message is within the longest", message.length <= longest_, true);
  message.from.processor = processor_;
  give_back(std::move(message));
}

void Client::give_back(Message message) { out(into_, Handed{std::move(message), pointers_}); }

Routing make_routing(Method method, const topologies::Topology& topology,
                     const topologies::RoutingTable& routes, const std::optional<TreeLinks>& tree) {
  if (method == Method::acyclic) return make_acyclic_routing(topology, routes);
  return {topology, routes, tree};
}

void Network::make_node(int id, machine::Processor& processor, const Params& params) {
  const std::uint64_t bytes = params.buffers * (params.longest + Message::IDENTIFICATION);
  auto& memory = processor.memory();
  if (const auto left = memory.left(); bytes > left || params.longest > left)
    base::refuse(processor.name(),
                 "found {3} bytes of memory left, expected {2} for the router's buffers ({0} "
                 "messages of {1} bytes and their identification): give shorter messages, more "
                 "memory or, if the program has that key, fewer buffers",
                 params.buffers, params.longest, bytes, left);
  memory.allocate(bytes, "the router's buffers", {});
  Node& node = nodes_.emplace_back();
  node.id = id;
  node.processor = &processor;
  node.routing = &routing_;
  node.buffers = params.buffers;
  node.pointers = params.pointers;
  node.costs = RouterCosts(processor.model());
  node.processes = params.processes.empty() ? std::vector{~0U} : params.processes.at(id);
  base::check_equal("at most MAX_CLIENTS clients", node.processes.size() <= MAX_CLIENTS, true);
  auto& clients = clients_.emplace_back();
  for (std::size_t n = 0; n < node.processes.size(); ++n) {
    const auto name = fmt::format("{}.client{}", processor.name(), n);
    const auto* companion =
        n == 0 || params.companions.empty() ? nullptr : params.companions.at(id);
    clients.push_back(std::make_unique<Client>(id, name, params.pointers, params.longest,
                                               companion ? *companion : processor, processor));
    node.client_in.push_back(&clients.back()->into_);
    node.client_out.push_back(&clients.back()->from_);
  }
}

Network::Network(machine::Machine& machine, Routing routing, const Params& params, int first)
    : routing_(std::move(routing)) {
  if (params.method == Method::acyclic)
    base::check_equal("routes without cycles", routing_.kind() == Routing::Kind::up_down, true);
  const auto& topology = routing_.topology();
  const auto at = [&](int id) -> machine::Processor& {
    return *machine.processors().at(first + id);
  };
  for (int id = 0; id < topology.processors; ++id) make_node(id, at(id), params);
  const auto joined = join(machine, topology, at);
  for (std::size_t i = 0; i < joined.size(); ++i) {
    const auto& [a, b] = topology.links[i];
    for (const auto& [from, to, direction] :
         {std::tuple{a, b, joined[i][0]}, std::tuple{b, a, joined[i][1]}}) {
      auto& channel = links_.emplace_back(direction->name(), *direction, occam::Protocol::counted);
      nodes_[from.processor].link_out[from.port] = &channel;
      nodes_[to.processor].link_in[to.port] = &channel;
    }
  }
  // After a failure, all routers use new routes at once. This simulates an ideal service outside
  // the machine.
  machine.on_failure([this, first](const machine::Failure& failure) {
    const auto number = [first](const machine::Processor* p) { return p->id() - first; };
    if (failure.b) return routing_.cut(number(failure.a), number(failure.b));
    for (const auto& link : topologies::Topology(routing_.topology()).links)
      if (link.a.processor == number(failure.a) || link.b.processor == number(failure.a))
        routing_.cut(link.a.processor, link.b.processor);
  });
  constexpr void (*START[])(Node&) = {&start_naive, &start_chalmers, &start_green, &start_acyclic};
  for (Node& node : nodes_) START[static_cast<std::size_t>(params.method)](node);
}

RouterUse Network::use() const {
  RouterUse sum;
  for (const Node& node : nodes_) sum += node.use;
  return sum;
}

}  // namespace network

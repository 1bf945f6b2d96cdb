#include "simulator/network/routing.hpp"

#include <algorithm>

#include "topologies/graph/search.hpp"

namespace network {

namespace {

bool joins(const std::pair<int, int>& link, int a, int b) {
  return std::minmax(link.first, link.second) == std::minmax(a, b);
}

}  // namespace

Routing::Routing(const topologies::Topology& topology, topologies::RoutingTable routes,
                 std::optional<TreeLinks> tree, Kind kind)
    : epochs_{{topology, std::move(tree)}},
      routes_(std::move(routes)),
      kind_(kind),
      neighbour_(static_cast<std::size_t>(topology.processors),
                 std::vector(topologies::PORTS, -1)) {
  for (const auto& link : topology.links) {
    neighbour_[link.a.processor][link.a.port] = link.b.processor;
    neighbour_[link.b.processor][link.b.port] = link.a.processor;
  }
}

double Routing::mean_distance() const {
  double sum = 0, pairs = 0;
  for (int from = 0; from < processors(); ++from)
    for (int to = 0; to < processors(); ++to)
      if (const int links = distance(from, to); links > 0) sum += links, ++pairs;
  return pairs > 0 ? sum / pairs : 0;
}

void Routing::cut(int a, int b) {
  Epoch next{topology(), {}};
  std::erase_if(next.topology.links, [&](const topologies::Link& link) {
    return joins({link.a.processor, link.b.processor}, a, b);
  });
  routes_ =
      kind_ == Kind::up_down ? make_up_down_routes(next.topology) : make_routes(next.topology);
  if (epochs_.back().tree) next.tree = make_tree_links(next.topology);
  epochs_.push_back(std::move(next));
}

Routing::Ports Routing::make_tree(const Epoch& epoch, int sender) const {
  topologies::Topology allowed = epoch.topology;
  if (epoch.tree)
    std::erase_if(allowed.links, [&](const topologies::Link& link) {
      return std::ranges::none_of(*epoch.tree, [&](const auto& branch) {
        return joins(branch, link.a.processor, link.b.processor);
      });
    });
  const auto search = topologies::make_search(allowed, sender);
  Ports ports(static_cast<std::size_t>(processors()));
  for (int at = 0; at < processors(); ++at)
    for (int port = 0; port < topologies::PORTS; ++port)
      if (const int child = neighbour(at, port); child >= 0 && search.parent[child] == at)
        ports[at].push_back(port);
  return ports;
}

const std::vector<int>& Routing::tree_ports(std::size_t epoch, int sender, int at) const {
  const Epoch& then = epochs_.at(epoch);
  auto tree = then.trees.find(sender);
  if (tree == then.trees.end()) tree = then.trees.emplace(sender, make_tree(then, sender)).first;
  return tree->second[at];
}

std::vector<int> Routing::below(std::size_t epoch, int sender, int at) const {
  std::vector<int> processors{at};
  for (std::size_t i = 0; i < processors.size(); ++i)
    for (const int port : tree_ports(epoch, sender, processors[i]))
      processors.push_back(neighbour(processors[i], port));
  return processors;
}

Routing make_acyclic_routing(const topologies::Topology& topology,
                             const topologies::RoutingTable& routes) {
  const auto tree = make_tree_links(topology);
  const bool cyclic = closes_cycle(topology, routes, tree);
  return {topology, cyclic ? make_up_down_routes(topology) : routes, tree, Routing::Kind::up_down};
}

}  // namespace network

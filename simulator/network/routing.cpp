#include "simulator/network/routing.hpp"

#include <algorithm>
#include <array>
#include <set>

#include "topologies/graph/search.hpp"

namespace network {

namespace {

// Makes, for each set of ports given as a bit mask, the list of the ports in it.
auto make_port_lists() {
  std::array<std::vector<int>, 1U << topologies::PORTS> lists;
  for (unsigned set = 0; set < lists.size(); ++set)
    for (int port = 0; port < topologies::PORTS; ++port)
      if (set >> port & 1U) lists[set].push_back(port);
  return lists;
}

}  // namespace

Routing::Routing(const topologies::Topology& topology, topologies::RoutingTable routes,
                 std::optional<TreeLinks> tree, Kind kind)
    : routes_(std::move(routes)),
      kind_(kind),
      peers_(make_peers(topology)),
      parallel_(parallel_ports(topology)) {
  add_epoch(topology, std::move(tree));
}

void Routing::add_epoch(topologies::Topology topology, std::optional<TreeLinks> tree) {
  auto allowed = topology;
  if (tree) {
    const std::set<std::pair<int, int>> branches(tree->begin(), tree->end());
    std::erase_if(allowed.links, [&](const topologies::Link& link) {
      return !branches.contains({link.a.processor, link.b.processor});
    });
  }
  epochs_.push_back({std::move(topology), std::move(tree), std::move(allowed)});
}

void Routing::cut(int a, int b) {
  auto left = topology();
  std::erase_if(left.links, [&](const topologies::Link& link) {
    return std::minmax(a, b) == std::minmax(link.a.processor, link.b.processor);
  });
  routes_ = kind_ == Kind::up_down ? make_up_down_routes(left) : make_routes(left);
  auto tree = epochs_.back().tree ? std::optional(make_tree_links(left)) : std::nullopt;
  add_epoch(std::move(left), std::move(tree));
}

Routing::Ports Routing::make_tree(const Epoch& epoch, int sender) const {
  const auto search = topologies::make_search(epoch.allowed, sender);
  Ports ports(static_cast<std::size_t>(processors()));
  for (int at = 0; at < processors(); ++at)
    for (int port = 0; port < topologies::PORTS; ++port) {
      const int child = neighbour(at, port);
      const bool is_first = std::ranges::find(peers_[at], child) - peers_[at].begin() == port;
      if (is_first && child >= 0 && search.parent[child] == at)
        ports[at] |= static_cast<std::uint8_t>(1U << port);
    }
  return ports;
}

const std::vector<int>& Routing::tree_ports(std::size_t epoch, int sender, int at) const {
  static const auto PORTS_OF = make_port_lists();
  const Epoch& then = epochs_.at(epoch);
  auto& [lock, trees] = *then.trees;
  const std::lock_guard guard(lock);
  auto tree = trees.find(sender);
  if (tree == trees.end()) tree = trees.emplace(sender, make_tree(then, sender)).first;
  return PORTS_OF[tree->second[at]];
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

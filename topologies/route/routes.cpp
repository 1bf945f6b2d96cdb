#include "topologies/route/routes.hpp"

#include <algorithm>

#include "topologies/graph/search.hpp"

namespace topologies {

static_assert(MAX_PROCESSORS * PORTS <= 65536, "a hop must fit 16 bits");

RoutingTable make_routes(const Topology& topology) {
  const int n = topology.processors;
  const auto around = neighbours(topology);
  RoutingTable table{n, std::vector<std::uint16_t>(static_cast<size_t>(n) * n)};
  for_each_search(topology, [&](int to, const Search& search) {
    for (int from = 0; from < n; ++from) {
      if (from == to) continue;
      auto& hop = table.hops[static_cast<size_t>(to) * n + from];
      const int distance = search.distance[from];
      if (distance < 0) {
        hop = RoutingTable::NONE;
        continue;
      }
      const auto next = std::ranges::find_if(around[from], [&](const Neighbour& neighbour) {
        return search.distance[neighbour.processor] == distance - 1;
      });
      hop = static_cast<std::uint16_t>(distance * PORTS + next->port);
    }
  });
  return table;
}

SpanningTree make_spanning_tree(const Topology& topology, int root) {
  auto search = make_search(topology, root);
  SpanningTree tree{root, std::move(search.parent), {}, std::move(search.distance)};
  tree.children.resize(topology.processors);
  for (const int p : search.order)
    if (p != root) tree.children[tree.parent[p]].push_back(p);
  return tree;
}

}  // namespace topologies

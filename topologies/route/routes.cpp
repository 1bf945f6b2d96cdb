#include "topologies/route/routes.hpp"

#include <algorithm>
#include <numeric>
#include <set>

#include "base/errors.hpp"
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

TreeLinks make_tree_links(const Topology& topology) {
  TreeLinks links;
  for_each_piece(topology, [&](int start, const Search& search) {
    for (const int p : search.order)
      if (p != start) links.push_back(std::minmax(p, int{search.parent[p]}));
  });
  std::ranges::sort(links);
  return links;
}

TreeLinks check_tree_links(const Topology& topology, const TreeLinks& links) {
  const auto refuse = [&](int a, int b, const char* why) {
    throw base::BadInput(
        fmt::format("found [{}, {}], {}; expected the links of a spanning tree of {}", a, b, why,
                    topology.name));
  };
  std::set<std::pair<int, int>> known;
  for (const auto& link : topology.links) known.emplace(link.a.processor, link.b.processor);
  // The part that each processor is in; the links so far join the processors of a part.
  std::vector<int> part(topology.processors);
  std::iota(part.begin(), part.end(), 0);
  TreeLinks sorted;
  for (const auto& [a, b] : links) {
    const std::pair<int, int> link = std::minmax(a, b);
    if (!known.contains(link)) refuse(a, b, "but no link joins the two");
    if (std::ranges::find(sorted, link) != sorted.end()) refuse(a, b, "twice");
    if (part[a] == part[b]) refuse(a, b, "which closes a cycle");
    std::ranges::replace(part, int{part[a]}, int{part[b]});
    sorted.push_back(link);
  }
  const auto apart = std::ranges::find_if(part, [&](int p) { return p != part[topology.root]; });
  if (apart != part.end())
    throw base::BadInput(
        fmt::format("no link reaches processor {} from the root {}; expected the links of a "
                    "spanning tree of {}",
                    apart - part.begin(), topology.root, topology.name));
  std::ranges::sort(sorted);
  return sorted;
}

}  // namespace topologies

#include "topologies/route/up_down.hpp"

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/topological_sort.hpp>
#include <limits>
#include <tuple>

#include "topologies/graph/search.hpp"

namespace topologies {

namespace {

// The distance of each processor from the root of its tree.
std::vector<int> find_depths(const Topology& topology) {
  std::vector<int> depth(topology.processors);
  for_each_piece(topology, [&](int, const Search& search) {
    for (const int p : search.order) depth[p] = search.distance[p];
  });
  return depth;
}

constexpr int FAR = std::numeric_limits<int>::max() / 2;

// A processor's route to one destination: its length in links, and its first port.
struct Way {
  int length = FAR, port = -1;
};

class UpDown {
 public:
  explicit UpDown(const Topology& topology)
      : around_(neighbours(topology)), depth_(find_depths(topology)) {
    for (int p = 0; p < topology.processors; ++p) downwards_.push_back(p);
    std::ranges::sort(downwards_, [&](int a, int b) { return is_above(a, b); });
  }

  std::vector<Way> find_ways(int to) const {
    std::vector<Way> ways(around_.size());
    ways[to].length = 0;
    // Links down, taken from the bottom, lead to processors below.
    for (auto p = downwards_.rbegin(); p != downwards_.rend(); ++p)
      for (const auto& n : around_[*p])
        if (is_above(*p, n.processor)) improve(ways[*p], ways[n.processor], n.port);
    // A processor that cannot send down sends up; these are taken from the top.
    for (const int p : downwards_)
      if (ways[p].length >= FAR)
        for (const auto& n : around_[p])
          if (is_above(n.processor, p)) improve(ways[p], ways[n.processor], n.port);
    return ways;
  }

 private:
  bool is_above(int a, int b) const { return std::tie(depth_[a], a) < std::tie(depth_[b], b); }
  static void improve(Way& way, const Way& next, int port) {
    if (next.length + 1 < way.length) way = {next.length + 1, port};
  }

  std::vector<std::vector<Neighbour>> around_;
  std::vector<int> depth_, downwards_;
};

}  // namespace

RoutingTable make_up_down_routes(const Topology& topology) {
  const int n = topology.processors;
  RoutingTable table{n, std::vector<std::uint16_t>(static_cast<size_t>(n) * n)};
  const UpDown up_down(topology);
  for (int to = 0; to < n; ++to) {
    const auto ways = up_down.find_ways(to);
    for (int from = 0; from < n; ++from) {
      const Way& way = ways[from];
      table.hops[static_cast<size_t>(to) * n + from] =
          from == to     ? std::uint16_t{0}
          : way.port < 0 ? RoutingTable::NONE
                         : static_cast<std::uint16_t>(way.length * PORTS + way.port);
    }
  }
  return table;
}

bool closes_cycle(const Topology& topology, const RoutingTable& routes, const TreeLinks& tree) {
  // A vertex for each direction of a link: 4 * processor + port it leaves by.
  boost::adjacency_list<boost::setS> waits(static_cast<size_t>(topology.processors) * PORTS);
  const auto around = neighbours(topology);
  const auto leaves = [](int p, int port) { return static_cast<size_t>(p) * PORTS + port; };
  for (int p = 0; p < topology.processors; ++p)
    for (const auto& n : around[p])
      for (int to = 0; to < topology.processors; ++to)
        if (n.processor != to && routes.next_port(p, to) == n.port &&
            routes.next_port(n.processor, to) >= 0)
          add_edge(leaves(p, n.port), leaves(n.processor, routes.next_port(n.processor, to)),
                   waits);
  std::vector<std::vector<Neighbour>> branches(around.size());
  for (const auto& [a, b] : tree)
    for (const auto& [p, q] : {std::pair{a, b}, std::pair{b, a}})
      branches[p].push_back(*std::ranges::find(around[p], q, &Neighbour::processor));
  for (int p = 0; p < topology.processors; ++p)
    for (const auto& n : branches[p])
      for (const auto& next : branches[n.processor])
        if (next.processor != p) add_edge(leaves(p, n.port), leaves(n.processor, next.port), waits);
  try {
    std::vector<size_t> order;
    topological_sort(waits, std::back_inserter(order));
  } catch (const boost::not_a_dag&) {
    return true;
  }
  return false;
}

}  // namespace topologies

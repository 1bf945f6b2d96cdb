#include "topologies/route/up_down.hpp"

#include <algorithm>
#include <limits>
#include <mutex>
#include <set>
#include <tuple>

#include "topologies/graph/search.hpp"
#include "topologies/route/packed_ports.hpp"

namespace topologies {

namespace {

// A processor's route to one destination: its length in links, and its first port.
struct Way {
  static constexpr int FAR = std::numeric_limits<int>::max() / 2;
  int length = FAR, port = 0;
};

// Up*/down* routes, found when needed and kept in a cache by destination.
class UpDown : public Rule {
 public:
  explicit UpDown(const Topology& topology)
      : Rule(topology),
        piece_(topology.processors),
        depth_(topology.processors),
        found_(topology.processors),
        finds_(topology.processors) {
    for_each_piece(topology, [&](int start, const Search& search) {
      for (const int p : search.order) piece_[p] = start, depth_[p] = search.distance[p];
    });
    for (int p = 0; p < topology.processors; ++p) downwards_.push_back(p);
    std::ranges::sort(downwards_, [&](int a, int b) { return is_above(a, b); });
  }

  int next_port(int from, int to) const override {
    if (piece_[from] != piece_[to]) return -1;
    auto& ports = found_[to];
    std::call_once(finds_[to], [&] {
      const auto ways = find_ways(to);
      ports = PackedPorts(processors());
      for (int p = 0; p < processors(); ++p) ports.set(p, ways[p].port);
    });
    return ports.get(from);
  }

  RouteSum sum_to(int to) const override {
    RouteSum sum;
    for (const auto& way : find_ways(to))
      if (way.length > 0 && way.length < Way::FAR) sum += {way.length, 1};
    return sum;
  }

 private:
  std::vector<Way> find_ways(int to) const {
    std::vector<Way> ways(peers().size());
    ways[to].length = 0;
    // Finds the routes that only go down. Visits the processors from the bottom up, because the
    // route of a processor continues with the route of a lower neighbour.
    for (auto p = downwards_.rbegin(); p != downwards_.rend(); ++p)
      for (int port = 0; port < PORTS; ++port)
        if (const int peer = peers()[*p][port]; is_above(*p, peer))
          improve(ways[*p], ways[peer], port);
    // All other routes first go up. Visits the processors from the top down, because such a route
    // continues with the route of a higher neighbour.
    for (const int p : downwards_)
      if (ways[p].length >= Way::FAR)
        for (int port = 0; port < PORTS; ++port)
          if (const int peer = peers()[p][port]; is_above(peer, p))
            improve(ways[p], ways[peer], port);
    return ways;
  }
  bool is_above(int a, int b) const { return std::tie(depth_[a], a) < std::tie(depth_[b], b); }
  static void improve(Way& way, const Way& next, int port) {
    if (next.length + 1 < way.length) way = {next.length + 1, port};
  }

  std::vector<int> piece_, depth_, downwards_;
  // For each destination: the first ports of the routes from all processors; empty until the first
  // query.
  mutable std::vector<PackedPorts> found_;
  mutable std::vector<std::once_flag> finds_;  // by destination
};

// True if the graph of turns has a cycle. A turn joins two directions of links, which are the
// vertices of this graph, numbered PORTS * processor + outgoing port. Repeatedly removes vertices
// without predecessors. If any vertices remain, there is a cycle.
bool has_cycle(const Turns& turns, const Peers& peers) {
  const auto for_each_next = [&](std::size_t way, auto visit) {
    const int peer = peers[way / PORTS][way % PORTS];
    for (int port = 0; port < PORTS; ++port)
      if (turns[way] >> port & 1U) visit(static_cast<std::size_t>(peer) * PORTS + port);
  };
  std::vector<std::uint8_t> leading(turns.size());
  for (std::size_t way = 0; way < turns.size(); ++way)
    for_each_next(way, [&](std::size_t next) { ++leading[next]; });
  std::vector<std::size_t> free;
  for (std::size_t way = 0; way < turns.size(); ++way)
    if (leading[way] == 0) free.push_back(way);
  for (std::size_t i = 0; i < free.size(); ++i)
    for_each_next(free[i], [&](std::size_t next) {
      if (--leading[next] == 0) free.push_back(next);
    });
  return free.size() < turns.size();
}

// The turns of broadcast messages. A broadcast can start at any processor and follows the links of
// `tree`.
Turns make_tree_turns(const Topology& topology, const Peers& peers, const TreeLinks& tree) {
  const std::set<std::pair<int, int>> links(tree.begin(), tree.end());
  // For each processor: the set of its ports in the tree, one bit each.
  std::vector<std::uint8_t> branches(peers.size());
  const auto distinct = distinct_links(topology);
  for (const auto& [a, b] : distinct)
    if (links.contains({a.processor, b.processor}))
      for (const End& end : {a, b})
        branches[end.processor] |= static_cast<std::uint8_t>(1U << end.port);
  Turns turns(peers.size() * PORTS);
  for (const auto& [a, b] : distinct)
    for (const auto& [here, there] : {std::pair{a, b}, std::pair{b, a}})
      if (branches[here.processor] >> here.port & 1U)
        turns[here.processor * PORTS + here.port] =
            branches[there.processor] & static_cast<std::uint8_t>(~(1U << there.port));
  return turns;
}

}  // namespace

RoutingTable make_up_down_routes(const Topology& topology) {
  return make_table(std::make_shared<UpDown>(topology));
}

bool closes_cycle(const Topology& topology, const RoutingTable& routes, const TreeLinks& tree) {
  // Size of the first batch of destinations, which is enough to find most cycles.
  constexpr int FIRST_LOOK = 64;
  const auto peers = make_peers(topology);
  auto turns = make_tree_turns(topology, peers, tree);
  int last = 0;
  while (last < topology.processors) {
    const int first = last;
    last = std::min(topology.processors, std::max(FIRST_LOOK, 2 * first));
    routes.rule->add_turns(turns, first, last);
    if (has_cycle(turns, peers)) return true;
  }
  return false;
}

}  // namespace topologies

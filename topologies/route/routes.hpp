#pragma once
// Shortest routes between all pairs of processors, and spanning trees.

#include <cstdint>
#include <utility>
#include <vector>

#include "topologies/graph/topology.hpp"

namespace topologies {

/// A message takes, among the neighbours of `from` that are one link nearer to `to`, the one on the
/// lowest port. On a hypercube that corrects the dimensions in a fixed order; on a mesh it goes
/// north first, then along the row, then south. Neither closes a cycle of waiting links.
/// Two bytes per ordered pair: 2 MB for 1024 processors, 32 MB for 4096, 512 MB for 16384.
struct RoutingTable {
  int processors = 0;
  std::vector<std::uint16_t> hops;  ///< distance * PORTS + port, at [to * processors + from]

  static constexpr std::uint16_t NONE = 65535;  ///< no way there, if links have been lost

  /// The port of `from` that leads to `to`; -1 when from == to, or if there is no way.
  int next_port(int from, int to) const {
    return from == to || hop(from, to) == NONE ? -1 : hop(from, to) % PORTS;
  }
  /// The distance in links; -1 if there is no way.
  int distance(int from, int to) const {
    return hop(from, to) == NONE ? -1 : hop(from, to) / PORTS;
  }
  int hop(int from, int to) const {
    return hops[static_cast<size_t>(to) * static_cast<size_t>(processors) + from];
  }
};

/// Makes the routes of a topology that passes `check`, or has lost some of its links.
RoutingTable make_routes(const Topology& topology);

struct SpanningTree {
  int root = 0;
  std::vector<int> parent;                 ///< -1 at the root
  std::vector<std::vector<int>> children;  ///< by ascending port of the parent
  std::vector<int> depth;                  ///< links from the root: the shortest distance
};

/// Searches a topology that passes `check` breadth first, neighbours by ascending port.
SpanningTree make_spanning_tree(const Topology& topology, int root);

/// Pairs of neighbours, the lower number first, sorted.
using TreeLinks = std::vector<std::pair<int, int>>;

/// The links of make_spanning_tree from the topology's root. A topology in pieces has one tree in
/// each, from the piece's lowest processor where the root is elsewhere.
TreeLinks make_tree_links(const Topology& topology);

/// Sorts given pairs, which may be in any order. Throws BadInput, naming the culprit, unless each
/// is a link of the topology, there once, and together they join all processors without a cycle.
TreeLinks check_tree_links(const Topology& topology, const TreeLinks& links);

}  // namespace topologies

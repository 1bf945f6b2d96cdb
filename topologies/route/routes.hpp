#pragma once
// Shortest routes between all pairs of processors, and spanning trees.

#include <memory>
#include <utility>
#include <vector>

#include "topologies/route/rule.hpp"

namespace topologies {

/// The routes between all pairs of processors, which copies share. Memory and time are those of the
/// rule; threads may ask side by side for ports and distances.
struct RoutingTable {
  int processors = 0;
  std::shared_ptr<const Rule> rule;
  bool is_shortest = false;  ///< those of make_routes

  /// The port of `from` that leads to `to`; -1 when from == to, or if there is no way.
  int next_port(int from, int to) const { return from == to ? -1 : rule->next_port(from, to); }
  /// The distance in links; -1 if there is no way.
  int distance(int from, int to) const { return rule->distance(from, to); }
  /// Links, over all ordered pairs that have a way; 0 if none has.
  double mean_distance() const;
};

/// Makes the shortest routes of a topology that passes `check`, or has lost some of its links. A
/// message takes, among the neighbours of `from` that are one link nearer to `to`, the one on the
/// lowest port. On a hypercube that corrects the dimensions in a fixed order; on a mesh it goes
/// north first, then along the row, then south. Neither closes a cycle of waiting links. Where
/// routes follow from places in a tree or a grid, there is no table: O(processors) memory. Others
/// are found when they are asked for, two bits a pair: at most 1 GB for 65536 processors.
RoutingTable make_routes(const Topology& topology);

/// Dimension order: a message goes along its row to the column of its end, then along that column;
/// on a torus the shorter way round, and where both are as long by the lower port; on a hypercube
/// through the dimensions by ascending port, which is what make_routes gives. On a mesh and on a
/// hypercube no cycle of waiting links is closed. Throws BadInput for any other topology.
RoutingTable make_xy_routes(const Topology& topology);

/// The routes of a rule.
RoutingTable make_table(std::shared_ptr<const Rule> rule);

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

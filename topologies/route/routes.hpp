#pragma once
// Shortest routes between all pairs of processors, and spanning trees.

#include <memory>
#include <utility>
#include <vector>

#include "topologies/route/rule.hpp"

namespace topologies {

/// The routes between all pairs of processors; copies share them. Memory and time are those of the
/// rule; threads may query ports and distances concurrently.
struct RoutingTable {
  int processors = 0;
  std::shared_ptr<const Rule> rule;
  bool is_shortest = false;  ///< from make_routes

  /// The port of `from` that leads to `to`; -1 if from == to or there is no route.
  int next_port(int from, int to) const { return from == to ? -1 : rule->next_port(from, to); }
  /// The length of the route in links; -1 if there is none.
  int distance(int from, int to) const { return rule->distance(from, to); }
  /// Mean length in links over all ordered pairs with a route; 0 if there are none.
  double mean_distance() const;
};

/// Makes the shortest routes of a topology that passes `check`, possibly after the loss of links. A
/// message takes the lowest port to a neighbour that is one link nearer to `to`. A hypercube thus
/// corrects its dimensions in a fixed order; a mesh goes north first, then along the row, then
/// south. Neither closes a cycle of waiting links. Trees and grids need no table and O(processors)
/// memory. Other routes are found on demand, in two bits a pair: at most 1 GB for 65536 processors.
RoutingTable make_routes(const Topology& topology);

/// Dimension order: a message goes along its row to the destination's column, then along that
/// column. A torus takes the shorter way round, and the lower port if both are equal. A hypercube
/// takes the dimensions by ascending port, as make_routes does. Meshes and hypercubes close no
/// cycle of waiting links. Throws BadInput for any other topology.
RoutingTable make_xy_routes(const Topology& topology);

/// A table of a rule's routes.
RoutingTable make_table(std::shared_ptr<const Rule> rule);

struct SpanningTree {
  int root = 0;
  std::vector<int> parent;                 ///< -1 at the root
  std::vector<std::vector<int>> children;  ///< by ascending port of the parent
  std::vector<int> depth;                  ///< links from the root: the shortest distance
};

/// Searches a topology that passes `check` breadth first, with neighbours by ascending port.
SpanningTree make_spanning_tree(const Topology& topology, int root);

/// Pairs of neighbours, the lower number first, sorted.
using TreeLinks = std::vector<std::pair<int, int>>;

/// The links of make_spanning_tree from the topology's root. A disconnected topology has one tree
/// per component; components without the root start at their lowest processor.
TreeLinks make_tree_links(const Topology& topology);

/// Checks pairs in any order and sorts them. Throws BadInput that names the first violation, unless
/// the pairs are distinct links of the topology and join all processors without a cycle.
TreeLinks check_tree_links(const Topology& topology, const TreeLinks& links);

}  // namespace topologies

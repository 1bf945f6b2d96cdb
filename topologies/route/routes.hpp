#pragma once
// Shortest routes between all pairs of processors, and spanning trees.

#include <memory>
#include <utility>
#include <vector>

#include "topologies/route/rule.hpp"

namespace topologies {

/// The routes between all pairs of processors. Copies share one rule; its class determines memory
/// and time. Threads may query ports and distances concurrently.
struct RoutingTable {
  int processors = 0;
  std::shared_ptr<const Rule> rule;
  bool is_shortest = false;  ///< the routes come from make_routes

  /// The port of `from` that leads to `to`; -1 if from == to or if there is no route.
  int next_port(int from, int to) const { return from == to ? -1 : rule->next_port(from, to); }
  /// The length of the route in links; -1 if there is no route.
  int distance(int from, int to) const { return rule->distance(from, to); }
  /// Mean length in links over all ordered pairs with a route; 0 if no pair has one.
  double mean_distance() const;
};

/// Makes shortest routes. The topology must pass `check`, but may have lost links since. A message
/// takes the lowest port to a neighbour that is one link nearer to `to`.
///
/// A hypercube thus corrects its dimensions in a fixed order. A mesh goes north, then along the
/// row, then south. Neither can deadlock in a cycle of waiting links. Trees and grids need no table
/// and only O(processors) memory. In other topologies, routes are found on demand and take two bits
/// per pair: at most 1 GB for 65536 processors.
RoutingTable make_routes(const Topology& topology);

/// Makes dimension-order routes for meshes, tori and hypercubes: along the row to the destination's
/// column, then along the column. A torus takes the shorter way round, or the lower port if both
/// ways are equal. A hypercube takes its dimensions by ascending port, as make_routes does.
///
/// Messages in meshes and hypercubes cannot deadlock in a cycle of waiting links. Throws BadInput
/// for any other topology.
RoutingTable make_xy_routes(const Topology& topology);

/// Makes a table that shares `rule` with its other owners.
RoutingTable make_table(std::shared_ptr<const Rule> rule);

struct SpanningTree {
  int root = 0;
  std::vector<int> parent;                 ///< -1 at the root
  std::vector<std::vector<int>> children;  ///< by ascending port of the parent
  std::vector<int> depth;                  ///< shortest distance from the root
};

/// Searches breadth first, with neighbours by ascending port. The topology must pass `check`.
SpanningTree make_spanning_tree(const Topology& topology, int root);

/// Pairs of neighbours, each with the lower number first, in ascending order.
using TreeLinks = std::vector<std::pair<int, int>>;

/// The links of make_spanning_tree from the topology's root. A disconnected topology has one tree
/// per component; a component without the root starts at its lowest processor.
TreeLinks make_tree_links(const Topology& topology);

/// Sorts pairs that may be in any order. Throws BadInput that names the first violation unless the
/// pairs are distinct links of the topology and form a spanning tree.
TreeLinks check_tree_links(const Topology& topology, const TreeLinks& links);

}  // namespace topologies

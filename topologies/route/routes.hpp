#pragma once
// Shortest routes between all pairs of processors, and spanning trees.

#include <memory>
#include <utility>
#include <vector>

#include "topologies/route/rule.hpp"

namespace topologies {

/// The routes between all pairs of processors. All copies share one Rule; the kind of rule
/// determines the memory and time of queries. Several threads may query ports and distances at the
/// same time.
struct RoutingTable {
  int processors = 0;
  std::shared_ptr<const Rule> rule;
  bool is_shortest = false;  ///< true if make_routes() made these routes

  /// The port of `from` that leads to `to`; -1 if from == to or if there is no route.
  int next_port(int from, int to) const { return from == to ? -1 : rule->next_port(from, to); }
  /// The length of the route in links; -1 if there is no route.
  int distance(int from, int to) const { return rule->distance(from, to); }
  /// Mean length in links over all ordered pairs with a route; 0 if no pair has one.
  double mean_distance() const;
};

/// Makes shortest routes. The topology must have passed `check`, but may have lost links
/// afterwards. A message takes the lowest port to a neighbour that is one link nearer to its
/// destination.
///
/// In a hypercube, a message therefore crosses the dimensions in a fixed order. In a mesh, it goes
/// north, then along the row, then south. Because of these fixed orders, messages in hypercubes and
/// meshes cannot deadlock in a cycle of waiting links.
///
/// Trees, meshes, tori and rings need no table and only O(processors) memory. In other topologies,
/// a route is found when it is first needed. A table of all routes takes two bits per pair of
/// processors: at most 1 GB for 65536 processors.
RoutingTable make_routes(const Topology& topology);

/// Makes dimension-order routes for meshes, tori and hypercubes: along the row to the destination's
/// column, then along the column. In a torus, a message takes the shorter way round, or the lower
/// port if both ways are equally long. In a hypercube, it crosses the dimensions by ascending port,
/// as with make_routes.
///
/// Messages in meshes and hypercubes cannot deadlock in a cycle of waiting links. Throws BadInput
/// for any other topology.
RoutingTable make_xy_routes(const Topology& topology);

/// Makes a table that shares the ownership of `rule`.
RoutingTable make_table(std::shared_ptr<const Rule> rule);

struct SpanningTree {
  int root = 0;
  std::vector<int> parent;                 ///< parent of each processor; -1 for the root
  std::vector<std::vector<int>> children;  ///< by ascending port of the parent
  /// Shortest distance of each processor from the root, in links.
  std::vector<int> depth;
};

/// Makes the tree by breadth-first search from `root`, with neighbours by ascending port. The
/// topology must pass `check`.
SpanningTree make_spanning_tree(const Topology& topology, int root);

/// Pairs of neighbours, each with the lower number first, in ascending order.
using TreeLinks = std::vector<std::pair<int, int>>;

/// The links of the spanning tree from the topology's root (make_spanning_tree). A disconnected
/// topology has one tree per connected component; in a component without the root, the tree starts
/// at the lowest processor.
TreeLinks make_tree_links(const Topology& topology);

/// Returns the links in the order of TreeLinks; `links` may be in any order. Throws BadInput that
/// names the first violation unless they are distinct links of the topology and form a spanning
/// tree.
TreeLinks check_tree_links(const Topology& topology, const TreeLinks& links);

}  // namespace topologies

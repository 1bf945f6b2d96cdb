#pragma once
// Deadlock-free routes for any topology (up*/down*: Schroeder et al., "Autonet", IEEE JSAC 9(8),
// 1991), and a test of routes for cyclic channel dependencies.

#include "topologies/route/routes.hpp"

namespace topologies {

/// Makes up*/down* routes. The upper end of a link is the one nearer to the root in the tree of
/// make_tree_links, or the lower number at equal depth. A route goes up zero or more links, then
/// down, as soon as possible. Since no upward link follows a downward one, links cannot wait for
/// each other in a cycle.
///
/// Routes may be longer than the shortest. The first query for a destination finds all routes to it
/// in O(processors) time, and caches them in two bits per pair.
RoutingTable make_up_down_routes(const Topology& topology);

/// True if messages can deadlock: each holds a link while it waits for the next, and the waits form
/// a cycle (W. Dally and C. Seitz, IEEE Trans. Computers 36(5), 1987). Includes broadcast messages,
/// which can start at any processor and follow `tree`.
bool closes_cycle(const Topology& topology, const RoutingTable& routes, const TreeLinks& tree);

}  // namespace topologies

#pragma once
// Deadlock-free routes for any topology (up*/down*: Schroeder et al., "Autonet", IEEE JSAC 9(8),
// 1991), and a test whether given routes can deadlock.

#include "topologies/route/routes.hpp"

namespace topologies {

/// Makes up*/down* routes. The upper end of a link is the one nearer to the root in the tree of
/// make_tree_links; at equal depth, it is the processor with the lower number. A route goes up zero
/// or more links and then down, and turns down as early as possible. Since no upward link follows a
/// downward one, links cannot wait for each other in a cycle.
///
/// Routes may be longer than the shortest. The first query for a destination finds all routes to it
/// in O(processors) time. A cache keeps them in two bits per pair.
RoutingTable make_up_down_routes(const Topology& topology);

/// True if messages can deadlock: each message holds a link while it waits for the next one, and
/// the waits form a cycle (W. Dally and C. Seitz, IEEE Trans. Computers 36(5), 1987). This includes
/// broadcast messages, which can start at any processor and follow the links of `tree`.
bool closes_cycle(const Topology& topology, const RoutingTable& routes, const TreeLinks& tree);

}  // namespace topologies

#pragma once
// Routes that close no cycle of waiting links, on any topology (up*/down*: Schroeder et al.,
// "Autonet", IEEE JSAC 9(8), 1991), and the check that tells whether given routes do.

#include "topologies/route/routes.hpp"

namespace topologies {

/// Every link has an upper end: the one nearer to the root of make_tree_links, the lower number of
/// two at the same distance. A route goes up some links, or none, and then down: since no link down
/// is ever followed by one up, no chain of links that wait for each other closes. A route that can
/// go down does; it may be longer than the shortest. Routes to a destination are found when they
/// are first asked for, in O(processors) time, and kept in two bits a pair.
RoutingTable make_up_down_routes(const Topology& topology);

/// True if messages that hold a link while they wait for the next on their route can wait for each
/// other in a cycle: W. Dally and C. Seitz, IEEE Trans. Computers 36(5), 1987. Messages to all take
/// `tree` from any of its processors.
bool closes_cycle(const Topology& topology, const RoutingTable& routes, const TreeLinks& tree);

}  // namespace topologies

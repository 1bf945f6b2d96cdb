#pragma once
// Routes that close no cycle of waiting links, on any topology (up*/down*: Schroeder et al.,
// "Autonet", IEEE JSAC 9(8), 1991), and a check of any routes for such cycles.

#include "topologies/route/routes.hpp"

namespace topologies {

/// The upper end of a link is nearer to the root of make_tree_links, or has the lower number at the
/// same distance. A route goes up zero or more links, then down. No upward link follows a downward
/// one, so links cannot wait for each other in a cycle. A route goes down as soon as it can; it may
/// be longer than the shortest. The first query finds all routes to a destination in O(processors)
/// time and keeps them in two bits a pair.
RoutingTable make_up_down_routes(const Topology& topology);

/// True if messages can wait for each other in a cycle, since each holds a link while it waits for
/// the next: W. Dally and C. Seitz, IEEE Trans. Computers 36(5), 1987. Broadcast messages follow
/// `tree` from any of its processors.
bool closes_cycle(const Topology& topology, const RoutingTable& routes, const TreeLinks& tree);

}  // namespace topologies

#pragma once
// Link loads of messages between all pairs of processors on given routes.

#include "topologies/graph/all_pairs.hpp"
#include "topologies/route/routes.hpp"

namespace topologies {

/// The load of one message per ordered pair with a route, by index into `links`. Takes
/// O(processors) memory beside the routes, and time in proportion to the pairs.
Load eval_load(const Topology& topology, const RoutingTable& routes);

}  // namespace topologies

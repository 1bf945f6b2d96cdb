#pragma once
// Link loads on given routes, for one message between every pair of processors.

#include "topologies/graph/all_pairs.hpp"
#include "topologies/route/routes.hpp"

namespace topologies {

/// The number of messages on each link, by index into `links`, if every ordered pair with a route
/// sends one. Takes O(processors) memory besides the routes, and time proportional to the number of
/// pairs.
Load eval_load(const Topology& topology, const RoutingTable& routes);

}  // namespace topologies

#pragma once
// Link loads on given routes, for one message between every pair of processors.

#include "topologies/graph/all_pairs.hpp"
#include "topologies/route/routes.hpp"

namespace topologies {

/// The number of messages on each link, by index into Topology::links, if every ordered pair of
/// processors with a route sends one message. Takes time proportional to the number of pairs, and
/// O(processors) memory in addition to the routes.
Load eval_load(const Topology& topology, const RoutingTable& routes);

}  // namespace topologies

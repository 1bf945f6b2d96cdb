#pragma once
// What messages between all pairs of processors add up to on given routes.

#include "topologies/graph/all_pairs.hpp"
#include "topologies/route/routes.hpp"

namespace topologies {

/// One message for each ordered pair that has a way, by the routes; by index into `links`. Takes
/// O(processors) memory beside the routes', and time in proportion to the pairs.
Load eval_load(const Topology& topology, const RoutingTable& routes);

}  // namespace topologies

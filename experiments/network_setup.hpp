#pragma once
// What [network] and [[fault]] mean on the topology of a point.
#include <optional>
#include <vector>

#include "experiments/experiment.hpp"
#include "topologies/routes.hpp"

namespace experiments {

// The shortest routes, or those that a file gives. Throws topologies::InvalidTopology.
topologies::RoutingTable find_routes(const Experiment& experiment,
                                     const topologies::Topology& topology);

// The single tree of messages to all; none where each sender has its own. Throws
// machine::InvalidInput.
std::optional<topologies::TreeLinks> find_tree(const Experiment& experiment,
                                               const topologies::Topology& topology);

// In the order of the file. Throws machine::InvalidInput, naming the [[fault]], for processors and
// links that are not there.
std::vector<patterns::PlannedFault> find_faults(const Experiment& experiment,
                                                const topologies::Topology& topology);

// Throws as these and as make_workers do.
void check_network(const Experiment& experiment);
// What they depend on: points of equal keys have equal networks.
std::string network_key(const Experiment& experiment);

}  // namespace experiments

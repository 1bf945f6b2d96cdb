#pragma once
// What [network] and [[fault]] mean on the topology of a point.
#include <optional>
#include <vector>

#include "experiments/laboratory/file/experiment.hpp"
#include "topologies/route/routes.hpp"

namespace laboratory {

/// The network of a point: "tree" and 7 workers is tree:7, "mesh" and 12 the most square mesh
/// of 12. Throws base::BadInput.
topologies::Topology make_workers(const Experiment& experiment);
/// Whether the topology says its size itself, so that `workers` is void.
bool has_own_workers(const Experiment& experiment);

// The shortest routes, or those that a file gives. Throws base::BadInput.
topologies::RoutingTable find_routes(const Experiment& experiment,
                                     const topologies::Topology& topology);

// The single tree of messages to all; none where each sender has its own. Throws
// base::BadInput.
std::optional<topologies::TreeLinks> find_tree(const Experiment& experiment,
                                               const topologies::Topology& topology);

// In the order of the file. Throws base::BadInput, naming the [[fault]], for processors and
// links that are not there.
std::vector<programs::PlannedFault> find_faults(const Experiment& experiment,
                                                const topologies::Topology& topology);

// Throws as these and as make_workers do.
void check_network(const Experiment& experiment);
// What they depend on: points of equal keys have equal networks.
std::string network_key(const Experiment& experiment);

}  // namespace laboratory

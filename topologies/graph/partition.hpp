#pragma once
#include "topologies/graph/topology.hpp"

namespace topologies {

/// The part of each processor, for parts of nearly as many processors with few links between them
/// (METIS, k-way): numbers from 0, each of them in use. There are `parts` > 0 of them, or fewer if
/// the topology does not have so many processors or does not come apart so. The same on any host.
std::vector<int> make_partition(const Topology& topology, int parts);

}  // namespace topologies

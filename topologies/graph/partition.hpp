#pragma once
#include "topologies/graph/topology.hpp"

namespace topologies {

/// The part of each processor: parts of nearly equal size with few links between them (METIS,
/// k-way), numbered from 0 without gaps. There are `parts` > 0 of them, or fewer if the topology is
/// too small or METIS leaves some empty. The same on any host.
std::vector<int> make_partition(const Topology& topology, int parts);

}  // namespace topologies

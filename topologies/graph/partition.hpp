#pragma once
#include "topologies/graph/topology.hpp"

namespace topologies {

/// Partitions the processors into at most `parts` parts of nearly equal size with few links between
/// them (METIS, k-way). `parts` must be positive. Returns the part of each processor, numbered from
/// 0 without gaps. There are fewer parts if the topology is too small or if METIS leaves parts
/// empty. The result is the same on every host.
std::vector<int> make_partition(const Topology& topology, int parts);

}  // namespace topologies

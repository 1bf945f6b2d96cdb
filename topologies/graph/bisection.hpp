#pragma once
#include "topologies/graph/topology.hpp"

namespace topologies {

/// So many processors at most can be halved in all ways in a moment.
constexpr int MOST_BISECTED = 32;

/// The fewest links between two halves, whose sizes differ by one at most: exact, by branch and
/// bound, for up to MOST_BISECTED processors.
int eval_bisection(const Topology& topology);

}  // namespace topologies

#pragma once
#include "topologies/graph/topology.hpp"

namespace topologies {

/// Largest number of processors for which the exact search of eval_bisection is fast.
constexpr int MOST_BISECTED = 32;

/// The bisection width: the minimum number of links between two halves whose sizes differ by at
/// most one. The result is exact. Throws BadInput for more than MOST_BISECTED processors.
int eval_bisection(const Topology& topology);

}  // namespace topologies

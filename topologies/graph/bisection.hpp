#pragma once
#include "topologies/graph/topology.hpp"

namespace topologies {

/// Largest number of processors for an exact bisection, which is then quick.
constexpr int MOST_BISECTED = 32;

/// The bisection width: the fewest links between two halves that differ by at most one processor.
/// Exact, by branch and bound; throws BadInput beyond MOST_BISECTED processors.
int eval_bisection(const Topology& topology);

}  // namespace topologies

#pragma once
// Distances and link loads for one message between every pair of processors.

#include <array>
#include <cstdint>
#include <vector>

#include "topologies/graph/topology.hpp"

namespace topologies {

/// Distances over all ordered pairs of processors in a connected topology.
struct Distances {
  std::int64_t sum = 0;  ///< sum of all distances, in links
  int longest = 0;       ///< the diameter, in links
};

/// Number of messages on each link, by index into Topology::links: [0] from a to b, [1] from b to
/// a.
using Load = std::vector<std::array<std::int64_t, 2>>;

/// Number of messages that a processor sends through a port, at [processor * PORTS + port].
using Sent = std::vector<std::int64_t>;

/// Spreads the messages to each neighbour evenly over all parallel links, even if `sent` counts
/// them all at one port. If the division leaves a remainder, the links on the lowest ports carry
/// one message more.
Load make_load(const Topology& topology, const Sent& sent);

struct AllPairs {
  Distances distances;
  Load load;  ///< one message per ordered pair, on the routes of make_routes
};

/// Measures a topology that passes `check`. Trees and grids take O(processors) time. Other
/// topologies take one search per orbit of equivalent processors, on all cores of the host: about
/// 10 ns per pair of processors and core. All results are exact.
AllPairs eval_all_pairs(const Topology& topology);

/// Like eval_all_pairs, but measures only the distances. For topologies other than trees and grids,
/// this takes three quarters of the time of eval_all_pairs.
Distances eval_distances(const Topology& topology);

/// The mean distance over ordered pairs of distinct processors; 0 for a single processor.
double eval_mean_distance(const Topology& topology);

}  // namespace topologies

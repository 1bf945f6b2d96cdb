#pragma once
// Distances and link loads of messages between all pairs of processors.

#include <array>
#include <cstdint>
#include <vector>

#include "topologies/graph/topology.hpp"

namespace topologies {

/// Distances between all ordered pairs of a connected topology's processors.
struct Distances {
  std::int64_t sum = 0;  ///< links
  int longest = 0;       ///< links: the diameter
};

/// Messages on each link: [0] from a to b, [1] from b to a.
using Load = std::vector<std::array<std::int64_t, 2>>;

/// At [processor * PORTS + port]: messages that the processor sends through the port.
using Sent = std::vector<std::int64_t>;

/// Spreads the messages to a neighbour evenly over the links to it, whatever port `sent` counts
/// them at. The lowest ports take the remainder.
Load make_load(const Topology& topology, const Sent& sent);

struct AllPairs {
  Distances distances;
  Load load;  ///< by index into `links`: one message per ordered pair, routed as by make_routes
};

/// Measures a topology that passes `check`. Trees and grids take O(processors) time. Others take
/// one search per orbit of equivalent processors, on all of the host's cores: some 10 ns a pair on
/// one core. Every number is exact.
AllPairs eval_all_pairs(const Topology& topology);

/// The distances alone; without a closed form, in three quarters of that time.
Distances eval_distances(const Topology& topology);

/// The mean distance of ordered pairs of distinct processors; 0 for one processor.
double eval_mean_distance(const Topology& topology);

}  // namespace topologies

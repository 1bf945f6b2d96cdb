#pragma once
// What messages between all pairs of processors add up to.

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

/// At [processor * PORTS + port] the messages that it sends there.
using Sent = std::vector<std::int64_t>;

/// Messages to a neighbour are shared by the links to it, evenly, the lowest port taking what is
/// over; whatever port they are counted at.
Load make_load(const Topology& topology, const Sent& sent);

struct AllPairs {
  Distances distances;
  Load load;  ///< one message per ordered pair, by the routes of make_routes; by index into `links`
};

/// Measures a topology that passes `check`. Trees and grids take O(processors) time, what looks the
/// same from some processors one search for all of these, and all others one for each processor: on
/// all of the host's cores, some 10 ns a pair on one. Every number is exact.
AllPairs eval_all_pairs(const Topology& topology);

/// The distances alone, in three quarters of that time where there is no rule.
Distances eval_distances(const Topology& topology);

/// The mean distance of ordered pairs of distinct processors; 0 for one processor.
double eval_mean_distance(const Topology& topology);

}  // namespace topologies

#pragma once
// Minimum-path networks, found by search.

#include "topologies/graph/topology.hpp"

namespace topologies {

/// Makes a minimum-path network (Chalmers and Tidmus's AMP): the one with the shortest mean
/// distance that a search of fixed length finds with four links a processor, three at the root,
/// where port 0 stays free. With more than 16384 processors it is a random network, which nothing
/// was looked for to better. n is 1 to MAX_PROCESSORS; throws BadInput. Host time: 0.1 s for 64
/// processors, 0.5 s for 256, 3 s for 1024 to 16384, 0.2 s for the most.
Topology make_amp(int n);

}  // namespace topologies

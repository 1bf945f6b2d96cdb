#pragma once
// Networks with short mean distances, found by search.

#include "topologies/graph/topology.hpp"

namespace topologies {

/// Makes a minimum-path network (the AMP of Chalmers and Tidmus): the network with the shortest
/// mean distance found by a search of fixed length. The root has three links, because its port 0
/// stays free; every other processor has four. With more than 16384 processors, the network is
/// random and not improved by the search.
///
/// n is 1 to MAX_PROCESSORS; otherwise throws BadInput. Host time is about 0.1 s for 64 processors,
/// 0.5 s for 256, 3 s for 1024 to 16384, and 0.2 s for MAX_PROCESSORS.
Topology make_amp(int n);

}  // namespace topologies

#pragma once
// Breadth-first search that visits neighbours by ascending port. Used for routes, trees and
// metrics.

#include <functional>
#include <vector>

#include "topologies/graph/topology.hpp"

namespace topologies {

struct Search {
  std::vector<int> order;     ///< the processors that were reached, in visiting order
  std::vector<int> parent;    ///< by processor; -1 for the start and for unreached processors
  std::vector<int> distance;  ///< by processor, in links from the start; -1 if unreached
};

/// Searches from processor `start`. Links must end at valid processors, but the topology may be
/// disconnected.
Search make_search(const Topology& topology, int start);

/// True if every processor can reach all others.
bool is_connected(const Topology& topology);

/// Searches each connected component and calls `visit` with the result. The first search starts at
/// the root, each later one at the lowest processor not yet reached.
void for_each_piece(const Topology& topology,
                    const std::function<void(int start, const Search&)>& visit);

}  // namespace topologies

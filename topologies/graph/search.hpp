#pragma once
// Breadth-first search, neighbours by ascending port: the base of routes, trees and metrics.

#include <functional>
#include <vector>

#include "topologies/graph/topology.hpp"

namespace topologies {

struct Search {
  std::vector<int> order;     ///< processors reached, in the order in which they were
  std::vector<int> parent;    ///< of each processor; -1 at the start and where not reached
  std::vector<int> distance;  ///< links from the start; -1 where not reached
};

/// Searches a topology with links that end at valid processors; it need not be connected.
Search make_search(const Topology& topology, int start);

/// True if each processor can be reached from each.
bool is_connected(const Topology& topology);

/// Calls `visit` with a search for each connected piece: first from the root, then from the lowest
/// processor that no search has reached.
void for_each_piece(const Topology& topology,
                    const std::function<void(int start, const Search&)>& visit);

}  // namespace topologies

#pragma once
// Breadth-first search with neighbours by ascending port, for routes, trees and metrics.

#include <functional>
#include <vector>

#include "topologies/graph/topology.hpp"

namespace topologies {

struct Search {
  std::vector<int> order;     ///< reached processors, in the order of the search
  std::vector<int> parent;    ///< by processor; -1 for the start and unreached processors
  std::vector<int> distance;  ///< by processor: links from the start; -1 if unreached
};

/// Searches a topology; its links must end at valid processors, but it need not be connected.
Search make_search(const Topology& topology, int start);

/// True if every processor can reach every other one.
bool is_connected(const Topology& topology);

/// Calls `visit` with a search for each connected component: first from the root, then from the
/// lowest unreached processor.
void for_each_piece(const Topology& topology,
                    const std::function<void(int start, const Search&)>& visit);

}  // namespace topologies

// Breadth-first search, neighbours by ascending port: what routes, trees and metrics are made of.
#pragma once

#include <functional>
#include <vector>

#include "topologies/graph/topology.hpp"

namespace topologies {

struct Search {
  std::vector<int> order;     // processors reached, in the order they were
  std::vector<int> parent;    // who reached each one first; -1 at the start and where not reached
  std::vector<int> distance;  // links from the start; -1 where not reached
};

// The search of a topology whose links end at valid processors. It need not be connected.
Search make_search(const Topology& topology, int start);

// One search from each processor in turn, in O(processors) memory.
void for_each_search(const Topology& topology,
                     const std::function<void(int start, const Search&)>& visit);

}  // namespace topologies

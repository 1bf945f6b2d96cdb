// The links of one spanning tree.
#pragma once

#include <utility>
#include <vector>

#include "topologies/graph/topology.hpp"

namespace topologies {

// Pairs of neighbours, the lower number first, sorted.
using TreeLinks = std::vector<std::pair<int, int>>;

// Those of make_spanning_tree from the topology's root. Of a topology in pieces one tree each, the
// others from their lowest processor.
TreeLinks make_tree_links(const Topology& topology);

// Given pairs in any order. Throws BadInput, naming the culprit, unless each is a link of
// the topology, there once, and together they join all processors without a cycle.
TreeLinks check_tree_links(const Topology& topology, const TreeLinks& links);

}  // namespace topologies

#pragma once
// The links of one spanning tree.

#include <utility>
#include <vector>

#include "topologies/graph/topology.hpp"

namespace topologies {

/// Pairs of neighbours, the lower number first, sorted.
using TreeLinks = std::vector<std::pair<int, int>>;

/// The links of make_spanning_tree from the topology's root. A topology in pieces has one tree in
/// each, from the piece's lowest processor where the root is elsewhere.
TreeLinks make_tree_links(const Topology& topology);

/// Sorts given pairs, which may be in any order. Throws BadInput, naming the culprit, unless each
/// is a link of the topology, there once, and together they join all processors without a cycle.
TreeLinks check_tree_links(const Topology& topology, const TreeLinks& links);

}  // namespace topologies

#pragma once
// Reads and writes topologies as DOT files (Graphviz).

#include <string>

#include "topologies/graph/topology.hpp"

namespace topologies {

/// Reads a DOT text by the rules of load_topology; `name` replaces the path in messages. Accepts
/// the language of Graphviz 2.42 and makes the same nodes and edges as Graphviz. A port in
/// node:port counts as the attribute `tailport` or `headport`. Throws BadInput with the line for a
/// second graph, subgraphs nested deeper than 100, more than 2^20 edges, macros, and words such as
/// 2x, which Graphviz splits.
Topology read_dot(const std::string& text, const std::string& name);

/// Writes DOT from which read_dot restores the processors, root, ports and labels. Throws BadInput
/// for a label that DOT cannot hold: one with an odd number of backslashes at its end, before a
/// quote or before a line end.
std::string to_dot(const Topology& topology);

}  // namespace topologies

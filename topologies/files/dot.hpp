#pragma once
// Topologies in DOT, read with Boost.Graph.

#include <string>

#include "topologies/graph/topology.hpp"

namespace topologies {

/// Reads a text by the rules of load_topology; `name` stands for the path. Refuses node:port, since
/// Boost's reader would drop the port, and an edge from one group in braces to another.
Topology read_dot(const std::string& text, const std::string& name);

/// Writes DOT that `read_dot` restores with the same processors, root, ports and labels. Throws
/// BadInput for a label that DOT cannot hold: a backslash at the end, before a quote or a line end.
std::string to_dot(const Topology& topology);

}  // namespace topologies

#pragma once
// Topologies in DOT, by Boost.Graph's reader.

#include <string>

#include "topologies/graph/topology.hpp"

namespace topologies {

/// Reads a text by the rules of load_topology; `name` stands for the path. Refuses node:port, which
/// Boost's reader would drop, and an edge from one group in braces to another.
Topology read_dot(const std::string& text, const std::string& name);

/// Read back, this gives the same processors, root, ports and labels. Throws BadInput for a label
/// that DOT cannot hold: with a backslash at the end, or before a quote or a line end.
std::string to_dot(const Topology& topology);

}  // namespace topologies

#pragma once
// Topologies in DOT, by Boost.Graph's reader and writer.

#include <string>

#include "topologies/graph/topology.hpp"

namespace topologies {

/// Reads a text by the rules of load_topology; `name` stands for the path. Refuses node:port, which
/// Boost's reader would drop, and an edge from one group in braces to another.
Topology read_dot(const std::string& text, const std::string& name);

/// Read back, this gives the same processors, root, ports and labels.
std::string to_dot(const Topology& topology);

}  // namespace topologies

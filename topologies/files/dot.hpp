#pragma once
// DOT files of topologies, read with Boost.Graph.

#include <string>

#include "topologies/graph/topology.hpp"

namespace topologies {

/// Reads a DOT text by the rules of load_topology; `name` replaces the path in messages. Refuses
/// node:port, because Boost's reader would drop the port. Refuses an edge between two groups in
/// braces.
Topology read_dot(const std::string& text, const std::string& name);

/// Writes DOT that `read_dot` restores with the same processors, root, ports and labels. Throws
/// BadInput for a label that DOT cannot hold: one with a backslash at its end, before a quote or
/// before a line end.
std::string to_dot(const Topology& topology);

}  // namespace topologies

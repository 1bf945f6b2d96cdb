#pragma once
// Topologies in GraphML, read with pugixml.

#include <string>

#include "topologies/graph/topology.hpp"

namespace topologies {

/// Reads a text by the rules of load_topology; `name` stands for the path.
Topology read_graphml(const std::string& text, const std::string& name);

/// Writes GraphML that `read_graphml` restores with the same processors, root, ports and labels.
std::string to_graphml(const Topology& topology);

}  // namespace topologies

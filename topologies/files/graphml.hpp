#pragma once
// GraphML files of topologies, read with pugixml.

#include <string>

#include "topologies/graph/topology.hpp"

namespace topologies {

/// Reads a GraphML text by the rules of load_topology; `name` replaces the path in messages.
Topology read_graphml(const std::string& text, const std::string& name);

/// Writes GraphML that `read_graphml` restores with the same processors, root, ports and labels.
std::string to_graphml(const Topology& topology);

}  // namespace topologies

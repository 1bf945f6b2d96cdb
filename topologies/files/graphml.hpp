#pragma once
// GraphML files of topologies.

#include <string>

#include "topologies/graph/topology.hpp"

namespace topologies {

/// Reads a text by the rules of load_topology; `name` stands for the path. Edge attributes
/// `sourceport` and `targetport` name ports as `tailport` and `headport` do. Refuses, with the
/// line, a second or nested graph, hyperedges, locators, and data without a key.
Topology read_graphml(const std::string& text, const std::string& name);

/// Writes GraphML that `read_graphml` restores with the same processors, root, ports and labels.
std::string to_graphml(const Topology& topology);

}  // namespace topologies

#pragma once
// Reads and writes topologies as GraphML files.

#include <string>

#include "topologies/graph/topology.hpp"

namespace topologies {

/// Reads a GraphML text by the rules of load_topology; `name` replaces the path in messages. Edge
/// attributes `sourceport` and `targetport` name ports as `tailport` and `headport` do in DOT.
/// Throws BadInput with the line for a second or nested graph, hyperedges, locators (links to other
/// files), and data without a key.
Topology read_graphml(const std::string& text, const std::string& name);

/// Writes GraphML from which read_graphml restores the processors, root, ports and labels.
std::string to_graphml(const Topology& topology);

}  // namespace topologies

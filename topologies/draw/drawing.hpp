#pragma once
// Drawing of a topology with the port numbers of its links.

#include <string>

#include "topologies/graph/topology.hpp"

namespace topologies {

/// Draws the topology as SVG text, by Graphviz, with processors placed by make_layout(). The root
/// has a double rim, and each end of a link shows its port number. Throws std::runtime_error if
/// Graphviz is not installed or fails.
std::string to_svg(const Topology& topology);

}  // namespace topologies

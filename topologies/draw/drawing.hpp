#pragma once
// Drawing of a topology with its ports.

#include <string>

#include "topologies/graph/topology.hpp"

namespace topologies {

/// An SVG by Graphviz with the places of make_layout(). The root has a double rim, and each end of
/// a link shows its port. Throws std::runtime_error if Graphviz is not installed or fails.
std::string to_svg(const Topology& topology);

}  // namespace topologies

#pragma once
// A topology drawn with its ports.

#include <string>

#include "topologies/graph/topology.hpp"

namespace topologies {

/// An SVG by Graphviz, placed by make_layout(): the root has a double rim, and each end of a link
/// its port. Throws std::runtime_error when Graphviz is not installed or fails.
std::string to_svg(const Topology& topology);

}  // namespace topologies

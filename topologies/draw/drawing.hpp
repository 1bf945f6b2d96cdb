#pragma once
// Drawing of a topology with the port numbers of its links.

#include <string>

#include "base/figure/figure_style.hpp"
#include "topologies/graph/topology.hpp"

namespace topologies {

/// Draws an SVG, with processors placed by make_layout(). The root has a double rim, and each end
/// of a link shows its port number. Throws as make_layout() does.
std::string to_svg(const Topology& topology, const base::FigureStyle& style = {});

}  // namespace topologies

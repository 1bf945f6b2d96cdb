#pragma once
// Places of port numbers in a drawing.
#include <array>
#include <vector>

#include "topologies/draw/layout.hpp"

namespace topologies {

/// Places of the port numbers at both ends of each link, by index into Topology::links.
using PortPlaces = std::vector<std::array<Place, 2>>;

/// Places each number beside its link, just outside the processor. If it would overlap an earlier
/// number or a processor, or lie on another link of its processor, it moves to the other side of
/// its link or further along. `size` is the height of a number, and `radius` the radius of a
/// processor, both in units of the layout.
PortPlaces place_ports(const Topology& topology, const Layout& layout, double size, double radius);

}  // namespace topologies

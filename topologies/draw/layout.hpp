// Where a drawing puts processors. Units: the least distance of two; y grows upwards.
#pragma once

#include <vector>

#include "topologies/graph/topology.hpp"

namespace topologies {

struct Place {
  double x = 0, y = 0;
};

using Places = std::vector<Place>;

struct Layout {
  Places processors;
  Places swerves;  // by index into Topology::links: how far off the straight line it is half way
};

// Lines and rings in rows to and fro (small rings in a circle), meshes and tori as grids whose
// closing links run between the lines, hypercubes as the tori they are; small trees from the root
// downwards, large ones and minimum-path networks in rings around it, with the way upwards from the
// root left open. Known by Topology::name. Others by Graphviz's neato, from a fixed start,
// turned so that the root is above the middle.
// Throws std::runtime_error when that is not installed.
Layout make_layout(const Topology& topology);

// By the spanning tree from the root: downwards where all links are the tree's and it is small,
// else around the root.
Places make_tree_places(const Topology& topology);

}  // namespace topologies

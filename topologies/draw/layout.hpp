#pragma once
// Where a drawing puts processors. The unit is the least distance of two; y grows upwards.

#include <vector>

#include "topologies/graph/topology.hpp"

namespace topologies {

struct Place {
  double x = 0, y = 0;
};

using Places = std::vector<Place>;

struct Layout {
  Places processors;
  Places swerves;  ///< by index into Topology::links: how far off the straight line it is half way
};

/// Places processors by Topology::shape: lines and rings in rows to and fro (small rings in a
/// circle), meshes and tori as grids with closing links between the lines, hypercubes as the
/// tori they are, minimum-path networks in rings around the root, with the way upwards from it left
/// open. Small trees grow from the root downwards, large ones around it. Others are placed by
/// Graphviz's neato, from a fixed start, and turned so that the root is above the middle; throws
/// std::runtime_error when that is not installed.
Layout make_layout(const Topology& topology);

}  // namespace topologies

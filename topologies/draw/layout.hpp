#pragma once
// Places of processors in a drawing. The unit is the smallest distance of two; y grows upwards.

#include <array>
#include <string>
#include <vector>

#include "topologies/graph/topology.hpp"

namespace topologies {

constexpr int MAX_DRAWN = 16384;  ///< processors of a drawing; some 15 MB at this limit

struct Place {
  double x = 0, y = 0;
};

using Places = std::vector<Place>;

struct Layout {
  Places processors;
  /// Offset of each link's midpoint from the straight line, by index into Topology::links. Links
  /// that join the same two processors run side by side.
  Places swerves;
};

/// The control points of a link's Bezier curve; its midpoint is `swerve` off the straight line.
std::array<Place, 4> make_curve(const Place& from, const Place& to, const Place& swerve);

/// The control points of that curve's first half, next to `from`.
std::array<Place, 4> make_half_curve(const Place& from, const Place& to, const Place& swerve);

/// Formats a place for Graphviz, in points on paper: "36.00,72.00".
std::string format_points(const Place& place);

/// Places processors by Topology::shape. Lines and rings are rows in alternating directions (small
/// rings: a circle). Meshes and tori are grids with closing links between the lines; hypercubes are
/// drawn as tori. Minimum-path networks are rings around the root with a gap above it. Small trees
/// grow downwards from the root, large ones around it. Graphviz's neato places other topologies,
/// from a fixed start, turned so that the root is on top; beyond 1024 processors they are rings
/// too. Throws std::runtime_error if Graphviz is missing, BadInput beyond MAX_DRAWN processors.
Layout make_layout(const Topology& topology);

}  // namespace topologies

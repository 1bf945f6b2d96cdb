#pragma once
// Where a drawing puts processors. The unit is the least distance of two; y grows upwards.

#include <array>
#include <string>
#include <vector>

#include "topologies/graph/topology.hpp"

namespace topologies {

constexpr int MAX_DRAWN = 16384;  ///< processors of a drawing: it has some 15 MB then

struct Place {
  double x = 0, y = 0;
};

using Places = std::vector<Place>;

struct Layout {
  Places processors;
  /// By index into Topology::links: how far off the straight line it is half way. Links that join
  /// the same two processors run side by side.
  Places swerves;
};

/// The control points of a link's Bezier curve, which is off the straight line by `swerve` half
/// way.
std::array<Place, 4> make_curve(const Place& from, const Place& to, const Place& swerve);

/// The control points of the half of that curve that is next to `from`.
std::array<Place, 4> make_half_curve(const Place& from, const Place& to, const Place& swerve);

/// A place as Graphviz takes it, in points of paper: "36.00,72.00".
std::string format_points(const Place& place);

/// Places processors by Topology::shape: lines and rings in rows to and fro (small rings in a
/// circle), meshes and tori as grids with closing links between the lines, hypercubes as the
/// tori they are, minimum-path networks in rings around the root, with the way upwards from it left
/// open. Small trees grow from the root downwards, large ones around it. Others are placed by
/// Graphviz's neato, from a fixed start, and turned so that the root is above the middle; throws
/// std::runtime_error when that is not installed. More than 1024 of these are in rings too. Throws
/// BadInput for more than MAX_DRAWN processors.
Layout make_layout(const Topology& topology);

}  // namespace topologies

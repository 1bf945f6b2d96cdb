#pragma once
// Places of processors in a drawing. The unit of length is the smallest distance between two
// processors; y grows upwards.

#include <array>
#include <string>
#include <vector>

#include "topologies/graph/topology.hpp"

namespace topologies {

constexpr int MAX_DRAWN = 16384;  ///< largest number of processors; their SVG has about 15 MB

struct Place {
  double x = 0, y = 0;
};

using Places = std::vector<Place>;

struct Layout {
  Places processors;
  /// Offset of each link's midpoint from the straight line, by index into Topology::links. Parallel
  /// links, between the same two processors, have different offsets.
  Places swerves;
};

/// The control points of a link's Bezier curve from `from` to `to`. `swerve` is the offset of the
/// curve's midpoint from the straight line.
std::array<Place, 4> make_curve(const Place& from, const Place& to, const Place& swerve);

/// The point of a Bezier curve at the parameter t, 0 to 1.
Place eval_curve(const std::array<Place, 4>& curve, double t);

/// The control points of the half of this curve that starts at `from`.
std::array<Place, 4> make_half_curve(const Place& from, const Place& to, const Place& swerve);

/// Places processors by Topology::shape:
/// - Lines and large rings are rows in alternating directions; small rings are circles.
/// - Meshes and tori are grids, with closing links between the grid lines; hypercubes are drawn as
///   tori.
/// - Minimum-path networks are rings around the root with a gap above it.
/// - Small trees grow downwards from the root, large trees around it.
/// - Other topologies are placed by Graphviz's neato from a fixed start and turned until the root
///   is at the top. Their links bend around other processors. With more than 1024 processors they
///   are rings around the root.
/// Throws std::runtime_error if Graphviz is not installed, and BadInput for more than MAX_DRAWN
/// processors.
Layout make_layout(const Topology& topology);

}  // namespace topologies

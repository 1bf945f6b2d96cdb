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

/// The control points of the first half of the curve that make_curve returns, next to `from`.
std::array<Place, 4> make_half_curve(const Place& from, const Place& to, const Place& swerve);

/// Formats a place for Graphviz in points (1/72 inch), such as "36.00,72.00".
std::string format_points(const Place& place);

/// Places processors according to Topology::shape:
/// - Lines and large rings become rows in alternating directions; small rings become circles.
/// - Meshes and tori become grids. The wrap-around links of a torus run between the grid lines.
/// - Hypercubes are drawn as tori.
/// - Minimum-path networks become concentric circles around the root, with a gap above it.
/// - Small trees grow downwards from the root; large trees surround it.
/// - Other topologies are placed by Graphviz's program neato from a fixed start, then rotated until
///   the root is at the top. With more than 1024 processors they become circles around the root.
/// Throws std::runtime_error if Graphviz is not installed, and BadInput for more than MAX_DRAWN
/// processors.
Layout make_layout(const Topology& topology);

}  // namespace topologies

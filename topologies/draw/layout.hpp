#pragma once
// Places of processors in a drawing. The unit of length is the smallest distance between two
// processors; y grows upwards.

#include <array>
#include <string>
#include <vector>

#include "topologies/graph/topology.hpp"

namespace topologies {

/// Largest number of processors in a drawing, which then has about 15 MB.
constexpr int MAX_DRAWN = 16384;

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

/// The control points of the first half, next to `from`, of the curve that make_curve() returns.
std::array<Place, 4> make_half_curve(const Place& from, const Place& to, const Place& swerve);

/// Places processors by Topology::shape:
/// - A line or a large ring is drawn as rows, traversed alternately in both directions. A small
///   ring is drawn as a circle.
/// - A mesh or a torus is a grid. The wrap-around links of a torus run between the grid lines. A
///   hypercube is drawn as a torus.
/// - A minimum-path network is drawn as rings around the root with a gap above the root.
/// - A small tree grows downwards from the root, a large tree around the root.
/// - Any other topology is placed by Graphviz's neato from a fixed start and turned until the root
///   is at the top. Its links bend around other processors. A topology of this kind with more than
///   1024 processors is drawn as rings around the root.
/// Throws std::runtime_error if Graphviz is not installed, and BadInput for more than MAX_DRAWN
/// processors.
Layout make_layout(const Topology& topology);

}  // namespace topologies

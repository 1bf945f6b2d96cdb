#pragma once
// Shortest routes of meshes, tori and rings, computed from rows and columns.

#include <algorithm>

#include "topologies/graph/grid.hpp"
#include "topologies/route/rule.hpp"

namespace topologies {

/// A route takes the lowest port to a neighbour nearer to the destination. Distances follow from
/// rows and columns.
class GridRule : public Rule {
 public:
  /// `grid` is the result of find_grid for the topology.
  GridRule(const Topology& topology, const Grid& grid) : Rule(topology), grid_(grid) {}

  int next_port(int from, int to) const override;
  int distance(int from, int to) const override { return grid_.distance(from, to); }
  RouteSum sum() const override;
  /// Adds all turns, pairs of successive ports on a route, at once. Takes O(processors) time
  /// because it tests only sample destinations. The next port depends only on the directions to the
  /// destination's row and column. These directions change only near the processor itself and near
  /// the place farthest from it, so destinations within three steps of either suffice.
  void add_turns(Turns& turns, int first, int last) const override;

 protected:
  const Grid& grid() const { return grid_; }
  /// The lowest port that leads nearer to `to`, to a neighbour for which `fits` returns true.
  int find_port(int from, int to, auto fits) const {
    const auto& around = peers()[from];
    const int here = grid_.distance(from, to);
    return static_cast<int>(
        std::ranges::find_if(
            around, [&](int peer) { return grid_.distance(peer, to) < here && fits(peer); }) -
        around.begin());
  }

 private:
  Grid grid_;
};

/// Dimension-order routing: a message goes first along the row, then along the column.
class XyRule : public GridRule {
 public:
  using GridRule::GridRule;
  int next_port(int from, int to) const override;
};

}  // namespace topologies

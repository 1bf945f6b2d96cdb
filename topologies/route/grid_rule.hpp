#pragma once
// Shortest routes of meshes, tori and rings, from rows and columns.

#include <algorithm>

#include "topologies/graph/grid.hpp"
#include "topologies/route/rule.hpp"

namespace topologies {

/// Takes the lowest port to a nearer neighbour; rows and columns give the distances.
class GridRule : public Rule {
 public:
  /// `grid` is the topology's grid from find_grid.
  GridRule(const Topology& topology, const Grid& grid) : Rule(topology), grid_(grid) {}

  int next_port(int from, int to) const override;
  int distance(int from, int to) const override { return grid_.distance(from, to); }
  RouteSum sum() const override;
  /// Adds all turns at once, in O(processors) time. The choice of port depends only on the sides of
  /// the destination's row and column. Destinations within two steps, or within two steps of the
  /// farthest place, already show every change after one step.
  void add_turns(Turns& turns, int first, int last) const override;

 protected:
  const Grid& grid() const { return grid_; }
  /// The lowest port to a nearer neighbour that `fits` accepts.
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

/// Dimension order: first along the row, then along the column.
class XyRule : public GridRule {
 public:
  using GridRule::GridRule;
  int next_port(int from, int to) const override;
};

}  // namespace topologies

#pragma once
// Shortest routes of meshes, tori and rings, by rows and columns.

#include <algorithm>

#include "topologies/graph/grid.hpp"
#include "topologies/route/rule.hpp"

namespace topologies {

/// Rows and columns tell how far each neighbour is; the lowest port to a nearer one is taken.
class GridRule : public Rule {
 public:
  /// The grid is the topology's: see find_grid.
  GridRule(const Topology& topology, const Grid& grid) : Rule(topology), grid_(grid) {}

  int next_port(int from, int to) const override;
  int distance(int from, int to) const override { return grid_.distance(from, to); }
  RouteSum sum() const override;
  /// Adds all turns at once, in time that grows with the number of processors alone: which of four
  /// neighbours are nearer depends on the sides on which rows and columns of the end are, and how
  /// that changes with one step shows at ends within two steps, or within two of the farthest.
  void add_turns(Turns& turns, int first, int last) const override;

 protected:
  const Grid& grid() const { return grid_; }
  /// The lowest port to a neighbour that is nearer and fits.
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

/// First along the row, then along the column: dimension order.
class XyRule : public GridRule {
 public:
  using GridRule::GridRule;
  int next_port(int from, int to) const override;
};

}  // namespace topologies

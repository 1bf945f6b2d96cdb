#pragma once
// Shortest routes of meshes, tori and rings, by rows and columns.

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

 private:
  Grid grid_;
};

}  // namespace topologies

#pragma once
// Topological sort of a dependency graph.
#include <cstddef>
#include <vector>

namespace base {

struct Order {
  std::vector<std::size_t> sorted;  ///< all indices, each after the indices that it needs
  /// The indices on one cycle; empty if the graph has no cycle. Each index needs the next one, and
  /// the last needs the first. If there is a cycle, `sorted` is incomplete.
  std::vector<std::size_t> circle;
};

/// Sorts by depth-first search, starting from the indices in ascending order. `needs[i]` lists the
/// indices that i needs. The search uses no recursion, so that a chain of needs can have any
/// length.
Order sort_by_needs(const std::vector<std::vector<std::size_t>>& needs);

}  // namespace base

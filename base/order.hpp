#pragma once
// Topological sort of a dependency graph.
#include <cstddef>
#include <vector>

namespace base {

struct Order {
  std::vector<std::size_t> sorted;  ///< all indices; each follows the indices that it needs
  /// A cycle, empty if there is none: each index needs the next, and the last needs the first. With
  /// a cycle, `sorted` is incomplete.
  std::vector<std::size_t> circle;
};

/// Sorts depth first, by ascending index. `needs[i]` lists the indices that i needs. The
/// implementation does not recurse, so chains of any length are possible.
Order sort_by_needs(const std::vector<std::vector<std::size_t>>& needs);

}  // namespace base

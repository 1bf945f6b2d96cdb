#pragma once
// Topological sort of a dependency graph.
#include <cstddef>
#include <vector>

namespace base {

struct Order {
  std::vector<std::size_t> sorted;  ///< every index, after the indices that it needs
  std::vector<std::size_t> circle;  ///< a cycle if there is one: each needs the next, the last the
                                    ///< first; `sorted` is then incomplete
};

/// `needs` holds, for each index, the indices that it needs. Sorts depth first by ascending index,
/// without recursion, so that any depth is possible.
Order sort_by_needs(const std::vector<std::vector<std::size_t>>& needs);

}  // namespace base

#pragma once
// What to do first where some things need others.
#include <cstddef>
#include <vector>

namespace base {

struct Order {
  std::vector<std::size_t> sorted;  ///< every index, after those that it needs
  std::vector<std::size_t> circle;  ///< if there is one: each needs the next, the last the first;
                                    ///< `sorted` is of no use then
};

/// `needs` holds, for each index, the indices that it needs. Sorts depth first, by ascending index;
/// needs may be as deep as there are indices.
Order sort_by_needs(const std::vector<std::vector<std::size_t>>& needs);

}  // namespace base

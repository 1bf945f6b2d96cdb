#include "base/order.hpp"

#include <algorithm>

namespace base {

Order sort_by_needs(const std::vector<std::vector<std::size_t>>& needs) {
  enum class State { untouched, open, sorted };
  Order order;
  std::vector<State> states(needs.size(), State::untouched);
  std::vector<std::size_t> next(needs.size(), 0);  // by index: number of its needs already visited
  std::vector<std::size_t> way;                    // stack of the depth-first search
  for (std::size_t first = 0; first < needs.size(); ++first) {
    if (states[first] == State::untouched) way.push_back(first);
    while (!way.empty()) {
      const auto index = way.back();
      states[index] = State::open;
      if (next[index] == needs[index].size()) {
        states[index] = State::sorted;
        order.sorted.push_back(index);
        way.pop_back();
        continue;
      }
      const auto needed = needs[index][next[index]++];
      if (states[needed] == State::open) {
        order.circle.assign(std::ranges::find(way, needed), way.end());
        return order;
      }
      if (states[needed] == State::untouched) way.push_back(needed);
    }
  }
  return order;
}

}  // namespace base

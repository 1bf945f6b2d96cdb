#include "topologies/route/tree_rule.hpp"

#include <algorithm>

#include "topologies/graph/search.hpp"

namespace topologies {

TreeRule::TreeRule(const Topology& topology)
    : Rule(topology), begin_(topology.processors), size_(topology.processors, 1) {
  const auto search = make_search(topology, topology.root);
  parent_ = search.parent, depth_ = search.distance;
  for (auto p = search.order.rbegin(); *p != topology.root; ++p) size_[parent_[*p]] += size_[*p];
  // For each processor: the first number in the subtree of its next child.
  std::vector<int> next(topology.processors, 1);
  for (const int p : search.order) {
    if (p == topology.root) continue;
    begin_[p] = begin_[parent_[p]] + next[parent_[p]];
    next[parent_[p]] += size_[p];
  }
}

int TreeRule::next_port(int from, int to) const {
  const auto& around = peers()[from];
  const bool down = is_below(to, from);
  return static_cast<int>(std::ranges::find_if(around,
                                               [&](int peer) {
                                                 if (peer == from) return false;
                                                 return down ? peer != parent_[from] &&
                                                                   is_below(to, peer)
                                                             : peer == parent_[from];
                                               }) -
                          around.begin());
}

int TreeRule::distance(int from, int to) const {
  int top = from;
  while (!is_below(to, top)) top = parent_[top];
  return depth_[from] + depth_[to] - 2 * depth_[top];
}

RouteSum TreeRule::sum() const {
  const std::int64_t n = processors();
  RouteSum sum{0, n * (n - 1)};
  for (const std::int64_t below : size_) sum.links += 2 * below * (n - below);  // 0 at the root
  return sum;
}

void TreeRule::add_turns(Turns& turns, int /*first*/, int /*last*/) const {
  for (int p = 0; p < processors(); ++p)
    for (int port = 0; port < PORTS; ++port)
      for (int next = 0; next < PORTS; ++next) {
        const int peer = peers()[p][port], end = peers()[peer][next];
        if (peer != p && end != peer && end != p) turns[p * PORTS + port] |= 1U << next;
      }
}

}  // namespace topologies

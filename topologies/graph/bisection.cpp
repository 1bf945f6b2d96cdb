// Bisection width of a tree, by dynamic programming over its subtrees.
#include <algorithm>

#include "topologies/graph/metrics.hpp"
#include "topologies/graph/search.hpp"

namespace topologies {
namespace {

constexpr int NEVER = MAX_PROCESSORS;  // more links than any tree has

// cuts[k]: fewest links cut within a subtree when k of its processors, its own root among them,
// are on that root's side.
using Cuts = std::vector<int>;

// Hangs `child` under `parent`: either on the same side, or on the other for one more cut.
Cuts merge_cuts(const Cuts& parent, const Cuts& child) {
  const size_t size = child.size() - 1;
  Cuts joined(child.size());
  for (size_t k = 0; k <= size; ++k) joined[k] = std::min(child[k], child[size - k] + 1);
  Cuts result(parent.size() + size, NEVER);
  for (size_t i = 1; i < parent.size(); ++i)
    for (size_t k = 0; k <= size; ++k)
      result[i + k] = std::min(result[i + k], parent[i] + joined[k]);
  return result;
}

}  // namespace

int eval_tree_bisection(const Topology& topology) {
  const int n = topology.processors;
  if (n == 1) return 0;
  const auto search = make_search(topology, topology.root);
  std::vector<Cuts> cuts(n, Cuts{NEVER, 0});
  for (auto p = search.order.rbegin(); *p != topology.root; ++p) {
    Cuts& parent = cuts[search.parent[*p]];
    parent = merge_cuts(parent, cuts[*p]);
    Cuts().swap(cuts[*p]);
  }
  const Cuts& all = cuts[topology.root];
  return std::min(all[n / 2], all[n - n / 2]);
}

}  // namespace topologies

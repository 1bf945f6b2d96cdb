#include "topologies/graph/metrics.hpp"

#include <algorithm>

#include "topologies/graph/bisection.hpp"
#include "topologies/graph/search.hpp"

namespace topologies {
namespace {

BusiestLink eval_farm(const Topology& topology, const std::vector<std::vector<Neighbour>>& around) {
  const auto search = make_search(topology, topology.root);
  std::vector<std::int64_t> below(topology.processors, 1);
  Load load(topology.links.size());
  for (auto p = search.order.rbegin(); *p != topology.root; ++p) {
    const int parent = search.parent[*p];
    const auto way = std::ranges::find(around[*p], parent, &Neighbour::processor);
    below[parent] += below[*p];
    load[way->link] = {below[*p], below[*p]};  // messages to the root, and replies from it
  }
  return find_busiest(topology, load);
}

constexpr int NEVER = MAX_PROCESSORS;  // exceeds the number of links in any tree

// A table for a subtree. At [k]: the minimum number of links cut inside the subtree if k of its
// processors, including its root, are on one side.
using Cuts = std::vector<int>;

// Merges the table of the subtree below `child` into the table of its parent. The child is on the
// parent's side, or on the opposite side at the cost of one more cut link.
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

// True if the tree has a link whose removal leaves two halves.
bool is_halved_by_a_link(const Search& search) {
  const int n = static_cast<int>(search.order.size());
  std::vector<int> below(n, 1);
  for (auto p = search.order.rbegin(); *p != search.order.front(); ++p) {
    if (below[*p] == n / 2 || below[*p] == n - n / 2) return true;
    below[search.parent[*p]] += below[*p];
  }
  return false;
}

// The bisection width of a tree, by dynamic programming over subtrees.
int eval_tree_bisection(const Topology& topology) {
  const int n = topology.processors;
  if (n == 1) return 0;
  const auto search = make_search(topology, topology.root);
  if (is_halved_by_a_link(search)) return 1;
  std::vector<Cuts> cuts(n, Cuts{NEVER, 0});
  for (auto p = search.order.rbegin(); *p != topology.root; ++p) {
    Cuts& parent = cuts[search.parent[*p]];
    parent = merge_cuts(parent, cuts[*p]);
    Cuts().swap(cuts[*p]);
  }
  const Cuts& all = cuts[topology.root];
  return std::min(all[n / 2], all[n - n / 2]);
}

}  // namespace

BusiestLink find_busiest(const Topology& topology, const Load& load) {
  BusiestLink busiest;
  for (size_t i = 0; i < load.size(); ++i)
    for (const int way : {0, 1})
      if (load[i][way] > busiest.messages) {
        const auto& [a, b] = topology.links[i];
        busiest = {(way ? b : a).processor, (way ? a : b).processor, load[i][way]};
      }
  return busiest;
}

Metrics eval_metrics(const Topology& topology) {
  const auto around = neighbours(topology);
  const std::int64_t n = topology.processors;
  Metrics metrics;
  metrics.processors = topology.processors;
  metrics.links = static_cast<int>(topology.links.size());
  const auto [fewest, most] = std::ranges::minmax(around, {}, [](auto& a) { return a.size(); });
  metrics.degree_min = static_cast<int>(fewest.size());
  metrics.degree_max = static_cast<int>(most.size());

  const auto [distances, load] = eval_all_pairs(topology);
  metrics.diameter = distances.longest;
  if (n > 1)
    metrics.mean_distance = static_cast<double>(distances.sum) / static_cast<double>(n * (n - 1));
  metrics.all_to_all = find_busiest(topology, load);
  metrics.farm = eval_farm(topology, around);

  metrics.bisection_width = topology.bisection_width;
  if (!metrics.bisection_width && is_tree(topology))
    metrics.bisection_width = eval_tree_bisection(topology);
  if (!metrics.bisection_width && topology.processors <= MOST_BISECTED)
    metrics.bisection_width = eval_bisection(topology);
  return metrics;
}

}  // namespace topologies

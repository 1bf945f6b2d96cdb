#include "topologies/graph/metrics.hpp"

#include <algorithm>
#include <array>

#include "topologies/graph/search.hpp"

namespace topologies {
namespace {

// Messages on each link: [0] from a to b, [1] from b to a.
using Load = std::vector<std::array<std::int64_t, 2>>;

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

// Adds one message from every processor to the start of `search`; `choose` picks the neighbour
// that a processor forwards to. Farthest first, so that what a processor forwards is complete.
template <typename Choose>
void add_gathering(const Topology& topology, const Search& search, Choose choose, Load& load) {
  std::vector<std::int64_t> forwarded(topology.processors, 1);
  for (auto p = search.order.rbegin(); *p != search.order.front(); ++p) {
    const Neighbour& next = choose(*p);
    forwarded[next.processor] += forwarded[*p];
    load[next.link][*p > next.processor] += forwarded[*p];
  }
}

BusiestLink eval_farm(const Topology& topology, const std::vector<std::vector<Neighbour>>& around) {
  Load load(topology.links.size());
  const auto search = make_search(topology, topology.root);
  const auto parent = [&](int p) -> const Neighbour& {
    return *std::ranges::find(around[p], search.parent[p], &Neighbour::processor);
  };
  add_gathering(topology, search, parent, load);
  for (auto& [forward, backward] : load) forward = backward = forward + backward;  // the replies
  return find_busiest(topology, load);
}

constexpr int NEVER = MAX_PROCESSORS;  // more links than any tree has

// At [k] the fewest links cut within a subtree when k of its processors, its own root among them,
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

// The bisection width of a wiring without cycles, by dynamic programming over subtrees.
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

}  // namespace

Metrics eval_metrics(const Topology& topology) {
  const auto around = neighbours(topology);
  const std::int64_t n = topology.processors;
  Metrics metrics;
  metrics.processors = topology.processors;
  metrics.links = static_cast<int>(topology.links.size());
  const auto [fewest, most] = std::ranges::minmax(around, {}, [](auto& a) { return a.size(); });
  metrics.degree_min = static_cast<int>(fewest.size());
  metrics.degree_max = static_cast<int>(most.size());

  Load load(topology.links.size());
  std::int64_t total = 0;
  for_each_search(topology, [&](int, const Search& search) {
    for (const int distance : search.distance) total += distance;
    metrics.diameter = std::max(metrics.diameter, search.distance[search.order.back()]);
    const auto nearer = [&](int p) -> const Neighbour& {  // the routing table's rule
      return *std::ranges::find_if(around[p], [&](const Neighbour& neighbour) {
        return search.distance[neighbour.processor] == search.distance[p] - 1;
      });
    };
    add_gathering(topology, search, nearer, load);
  });
  metrics.all_to_all = find_busiest(topology, load);
  metrics.farm = eval_farm(topology, around);
  if (n > 1) metrics.mean_distance = static_cast<double>(total) / static_cast<double>(n * (n - 1));

  metrics.bisection_width = topology.bisection_width;
  if (!metrics.bisection_width && is_tree(topology))
    metrics.bisection_width = eval_tree_bisection(topology);
  return metrics;
}

}  // namespace topologies

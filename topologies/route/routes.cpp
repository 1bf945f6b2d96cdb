#include "topologies/route/routes.hpp"

#include <algorithm>
#include <numeric>
#include <set>

#include "base/errors.hpp"
#include "topologies/graph/grid.hpp"
#include "topologies/graph/search.hpp"
#include "topologies/route/grid_rule.hpp"
#include "topologies/route/searched_rule.hpp"
#include "topologies/route/tree_rule.hpp"

namespace topologies {

RoutingTable make_table(std::shared_ptr<const Rule> rule) {
  const int processors = rule->processors();
  return {processors, std::move(rule), false};
}

double RoutingTable::mean_distance() const {
  const auto [links, pairs] = rule->sum();
  return pairs > 0 ? static_cast<double>(links) / static_cast<double>(pairs) : 0;
}

RoutingTable make_routes(const Topology& topology) {
  const auto make_rule = [&]() -> std::shared_ptr<const Rule> {
    if (is_tree(topology) && is_connected(topology)) return std::make_shared<TreeRule>(topology);
    if (const auto grid = find_grid(topology)) return std::make_shared<GridRule>(topology, *grid);
    return std::make_shared<SearchedRule>(topology);
  };
  return {topology.processors, make_rule(), true};
}

RoutingTable make_xy_routes(const Topology& topology) {
  using Form = Shape::Form;
  if (topology.shape.form == Form::hypercube) return make_routes(topology);
  if (topology.shape.form == Form::grid)
    if (const auto grid = find_grid(topology))
      return make_table(std::make_shared<XyRule>(topology, *grid));
  throw base::BadInput(
      fmt::format("topology {}: found no dimensions for dimension-order routing (xy), expected a "
                  "mesh, torus or hypercube given by its name",
                  topology.name));
}

SpanningTree make_spanning_tree(const Topology& topology, int root) {
  auto search = make_search(topology, root);
  SpanningTree tree{root, std::move(search.parent), {}, std::move(search.distance)};
  tree.children.resize(topology.processors);
  for (const int p : search.order)
    if (p != root) tree.children[tree.parent[p]].push_back(p);
  return tree;
}

TreeLinks make_tree_links(const Topology& topology) {
  TreeLinks links;
  for_each_piece(topology, [&](int start, const Search& search) {
    for (const int p : search.order)
      if (p != start) links.push_back(std::minmax(p, int{search.parent[p]}));
  });
  std::ranges::sort(links);
  return links;
}

TreeLinks check_tree_links(const Topology& topology, const TreeLinks& links) {
  const auto refuse = [&](int a, int b, const char* why) {
    throw base::BadInput(
        fmt::format("found [{}, {}], {}; expected the links of a spanning tree of {}", a, b, why,
                    topology.name));
  };
  std::set<std::pair<int, int>> known;
  for (const auto& link : topology.links) known.emplace(link.a.processor, link.b.processor);
  // Union-find over the links added so far. Following `leads` from a processor ends at the
  // representative of its connected component.
  std::vector<int> leads(topology.processors);
  std::iota(leads.begin(), leads.end(), 0);
  const auto part_of = [&](int p) {
    while (leads[p] != p) p = leads[p] = leads[leads[p]];
    return p;
  };
  std::set<std::pair<int, int>> found;
  TreeLinks sorted;
  for (const auto& [a, b] : links) {
    const std::pair<int, int> link = std::minmax(a, b);
    if (!known.contains(link)) refuse(a, b, "which is not a link of the network");
    if (!found.insert(link).second) refuse(a, b, "twice");
    if (part_of(a) == part_of(b)) refuse(a, b, "which closes a cycle");
    leads[part_of(a)] = part_of(b);
    sorted.push_back(link);
  }
  for (int p = 0; p < topology.processors; ++p)
    if (part_of(p) != part_of(topology.root))
      throw base::BadInput(
          fmt::format("found no path from the root {1} to processor {0}, expected the links of a "
                      "spanning tree of {2}",
                      p, topology.root, topology.name));
  std::ranges::sort(sorted);
  return sorted;
}

}  // namespace topologies

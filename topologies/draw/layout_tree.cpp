// Trees downwards, and around their root.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "topologies/draw/layout.hpp"
#include "topologies/route/routes.hpp"

namespace topologies {
namespace {

// The processors of each level from the root, in the order of their parents.
std::vector<std::vector<int>> make_levels(const SpanningTree& tree) {
  std::vector<std::vector<int>> levels{{tree.root}};
  while (!levels.back().empty()) {
    std::vector<int> next;
    for (const int p : levels.back())
      next.insert(next.end(), tree.children[p].begin(), tree.children[p].end());
    levels.push_back(std::move(next));
  }
  levels.pop_back();
  return levels;
}

// For each processor the middle of its leaves, which stand at 0, 1, 2 ...
std::vector<double> make_middles(const SpanningTree& tree) {
  std::vector<double> from(tree.parent.size()), to(tree.parent.size());
  double leaves = 0;
  const auto visit = [&](auto& self, int p) -> void {
    for (const int child : tree.children[p]) self(self, child);
    const auto& children = tree.children[p];
    from[p] = children.empty() ? leaves : from[children.front()];
    to[p] = children.empty() ? leaves++ : to[children.back()];
  };
  visit(visit, tree.root);
  for (size_t p = 0; p < from.size(); ++p) from[p] = (from[p] + to[p]) / 2;
  return from;
}

// Levels as rings around the root, from the angle on the right of the open way to that on its left;
// a level that is too dense for one ring zigzags.
Places make_rings(const SpanningTree& tree, const std::vector<double>& turns) {
  constexpr double PITCH = 1.15, GAP = 1.7, ZIGZAG = 1.1;
  Places places(tree.parent.size());
  double radius = 0;
  for (const auto& level : make_levels(tree)) {
    if (level.front() == tree.root) continue;
    double closest = 1;
    for (size_t i = 1; i < level.size(); ++i)
      closest = std::min(closest, turns[level[i]] - turns[level[i - 1]]);
    const double needed = PITCH / (2 * std::numbers::pi * closest);
    const bool dense = needed > radius + GAP + 1;
    radius = std::max(radius + GAP, dense ? needed / 2 : needed);
    for (size_t i = 0; i < level.size(); ++i) {
      const double r = radius + (dense && i % 2 ? ZIGZAG : 0);
      const double angle = std::numbers::pi * (0.5 - 2 * turns[level[i]]);
      places[level[i]] = {r * std::cos(angle), r * std::sin(angle)};
    }
    if (dense) radius += ZIGZAG;
  }
  return places;
}

}  // namespace

Places make_tree_places(const Topology& topology) {
  const auto tree = make_spanning_tree(topology, topology.root);
  auto middles = make_middles(tree);
  const double leaves = std::ranges::max(middles) + 1;
  constexpr double WIDEST = 32;
  const bool is_tree = static_cast<int>(topology.links.size()) == topology.processors - 1;
  if (leaves > WIDEST || !is_tree) {
    for (double& middle : middles) middle = (middle + 2) / (leaves + 3);
    return make_rings(tree, middles);
  }
  Places places;
  for (int p = 0; p < topology.processors; ++p)
    places.push_back({1.1 * middles[p], -1.8 * tree.depth[p]});
  return places;
}

}  // namespace topologies

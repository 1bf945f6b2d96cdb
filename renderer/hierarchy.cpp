#include "renderer/hierarchy.hpp"

namespace renderer {

namespace {

constexpr std::uint32_t NONE = Box::INNER;

struct Node {
  Bounds bounds;
  std::uint32_t item = NONE;
  std::uint32_t parent = NONE;
  std::uint32_t first = NONE, last = NONE, next = NONE;  // children, sibling
  std::uint32_t count = 0;                               // children
};

struct Tree {
  std::vector<Node> nodes;
  std::uint32_t root = NONE;
};

std::uint32_t add_node(Tree& tree, const Bounds& bounds, std::uint32_t item) {
  tree.nodes.push_back({bounds, item});
  return static_cast<std::uint32_t>(tree.nodes.size() - 1);
}

void append_child(Tree& tree, std::uint32_t parent, std::uint32_t child) {
  Node& p = tree.nodes[parent];
  tree.nodes[child].parent = parent;
  tree.nodes[child].next = NONE;
  if (p.first == NONE)
    p.first = child;
  else
    tree.nodes[p.last].next = child;
  p.last = child;
  ++p.count;
}

// Puts an inner node in the place of `leaf` and `leaf` under it.
std::uint32_t make_pair_place(Tree& tree, std::uint32_t leaf) {
  const std::uint32_t inner = add_node(tree, tree.nodes[leaf].bounds, NONE);
  const std::uint32_t parent = tree.nodes[leaf].parent;
  tree.nodes[inner].parent = parent;
  tree.nodes[inner].next = tree.nodes[leaf].next;
  if (parent == NONE) {
    tree.root = inner;
  } else {
    Node& p = tree.nodes[parent];
    std::uint32_t* link = &p.first;
    while (*link != leaf) link = &tree.nodes[*link].next;
    *link = inner;
    if (p.last == leaf) p.last = inner;
  }
  append_child(tree, inner, leaf);
  return inner;
}

// The node that `object` should join: an inner one as one more child, a leaf to form a pair.
// A node costs its area times its children; a choice at any level also pays for the growth of
// every node above it. Weighs joining each node on the way down and pairing with each of its
// leaves; the way leads to the inner child that grows least.
std::uint32_t find_place(const Tree& tree, const Bounds& object) {
  std::uint32_t best = tree.root;
  double least = Bounds::INF, inherited = 0;
  const auto offer = [&](std::uint32_t node, double cost) {
    if (cost < least) {
      least = cost;
      best = node;
    }
  };
  for (std::uint32_t node = tree.root, next = NONE; node != NONE && inherited < least;
       node = next) {
    next = NONE;
    const Node& n = tree.nodes[node];
    const double area = half_area(join(n.bounds, object));
    inherited += (area - half_area(n.bounds)) * n.count;
    offer(node, inherited + area);
    double least_growth = Bounds::INF;
    for (std::uint32_t c = n.first; c != NONE; c = tree.nodes[c].next) {
      const Bounds& child = tree.nodes[c].bounds;
      const double joined = half_area(join(child, object));
      if (tree.nodes[c].item != NONE) {
        offer(c, inherited + 2 * joined);
      } else if (joined - half_area(child) < least_growth) {
        least_growth = joined - half_area(child);
        next = c;
      }
    }
  }
  return best;
}

void insert(Tree& tree, const Bounds& object, std::uint32_t item) {
  const std::uint32_t leaf = add_node(tree, object, item);
  if (tree.root == NONE) {
    tree.root = leaf;
    return;
  }
  std::uint32_t place = find_place(tree, object);
  if (tree.nodes[place].item != NONE) place = make_pair_place(tree, place);
  append_child(tree, place, leaf);
  for (std::uint32_t up = place; up != NONE; up = tree.nodes[up].parent)
    tree.nodes[up].bounds = join(tree.nodes[up].bounds, object);
}

}  // namespace

Hierarchy make_hierarchy(std::span<const Bounds> objects) {
  Tree tree;
  tree.nodes.reserve(2 * objects.size());
  for (std::size_t i = 0; i < objects.size(); ++i)
    insert(tree, objects[i], static_cast<std::uint32_t>(i));

  // Flatten: down to the first child, else on to the next sibling of the nearest ancestor that
  // has one; the boxes left on the way up end here.
  Hierarchy flat;
  flat.boxes.reserve(tree.nodes.size());
  std::vector<std::uint32_t> open;
  for (std::uint32_t node = tree.root; node != NONE;) {
    open.push_back(static_cast<std::uint32_t>(flat.boxes.size()));
    flat.boxes.push_back({tree.nodes[node].bounds, 0, tree.nodes[node].item});
    if (tree.nodes[node].first != NONE) {
      node = tree.nodes[node].first;
      continue;
    }
    std::uint32_t next = NONE;
    while (node != NONE && next == NONE) {
      flat.boxes[open.back()].skip = static_cast<std::uint32_t>(flat.boxes.size());
      open.pop_back();
      next = tree.nodes[node].next;
      node = tree.nodes[node].parent;
    }
    node = next;
  }
  return flat;
}

}  // namespace renderer

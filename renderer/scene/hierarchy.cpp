#include "renderer/scene/hierarchy.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace renderer {

namespace {

constexpr std::uint32_t NONE = Box::INNER;

// Limit on the number of nodes visited by insertion: a constant, plus a number for each object.
constexpr std::size_t MOST_LOOKS = 10'000'000, MOST_LOOKS_PER_OBJECT = 2000;

struct Node {
  Bounds bounds;
  std::uint32_t item = NONE;
  std::uint32_t parent = NONE;
  std::vector<std::uint32_t> children = {};
};

struct Tree {
  std::vector<Node> nodes;
  std::uint32_t root = NONE;
  std::size_t looks = 0;  // number of nodes visited by insertion so far
};

std::uint32_t add_node(Tree& tree, const Bounds& bounds, std::uint32_t item) {
  tree.nodes.push_back({bounds, item});
  return static_cast<std::uint32_t>(tree.nodes.size() - 1);
}

void append_child(Tree& tree, std::uint32_t parent, std::uint32_t child) {
  tree.nodes[parent].children.push_back(child);
  tree.nodes[child].parent = parent;
}

// Replaces `leaf` by a new inner node with `leaf` as its only child, and returns the inner node.
std::uint32_t make_pair_place(Tree& tree, std::uint32_t leaf) {
  const std::uint32_t inner = add_node(tree, tree.nodes[leaf].bounds, NONE);
  const std::uint32_t parent = tree.nodes[leaf].parent;
  tree.nodes[inner].parent = parent;
  if (parent == NONE)
    tree.root = inner;
  else
    *std::ranges::find(tree.nodes[parent].children, leaf) = inner;
  append_child(tree, inner, leaf);
  return inner;
}

// The best node found so far that a new object can join.
struct Choice {
  std::uint32_t node = NONE;
  double cost = Bounds::INF;

  void offer(std::uint32_t other, double other_cost) {
    if (other_cost < cost) *this = {other, other_cost};
  }
};

// A node to be searched. `inherited` is the cost that the object adds to all nodes above it.
struct Way {
  std::uint32_t node;
  double inherited;
};

// Evaluates two ways to add `object`: as a further child of `way.node`, and paired with each leaf
// among the node's children. Appends to `ways` the nodes to be searched next.
void weigh(const Tree& tree, const Bounds& object, const Way& way, Choice& best,
           std::vector<Way>& ways) {
  const Node& n = tree.nodes[way.node];
  const double area = half_area(join(n.bounds, object));
  const double inherited =
      way.inherited + (area - half_area(n.bounds)) * static_cast<double>(n.children.size());
  best.offer(way.node, inherited + area);
  const std::size_t before = ways.size();
  double least_growth = Bounds::INF;
  for (const std::uint32_t c : n.children) {
    const Node& child = tree.nodes[c];
    const double joined = half_area(join(child.bounds, object));
    const double growth = joined - half_area(child.bounds);
    if (child.item != NONE) best.offer(c, inherited + 2 * joined);
    if (growth < least_growth) ways.resize(before);
    if (growth <= least_growth && child.item == NONE) ways.push_back({c, inherited});
    least_growth = std::min(least_growth, growth);
  }
  std::reverse(ways.begin() + static_cast<std::ptrdiff_t>(before), ways.end());
}

// Finds the node that `object` should join: an inner node, as another child, or a leaf, to form a
// pair with it. The cost of a node is its area multiplied by its number of children. The cost of a
// choice includes the growth of all nodes above. The search descends to the child that grows least.
// It ends at a leaf, or when no node below can be better, because every place costs at least the
// object's own area. If several children grow equally, because they contain the object, it tries
// all of them and takes the lowest cost. (Goldsmith and Salmon take the child with the nearest
// centre, or any.)
std::uint32_t find_place(Tree& tree, const Bounds& object) {
  Choice best{tree.root};
  if (tree.nodes[tree.root].item != NONE) return best.node;
  const double own = half_area(object);
  std::vector<Way> ways = {{tree.root, 0}};
  while (!ways.empty()) {
    const Way way = ways.back();
    ways.pop_back();
    if (!(way.inherited + own < best.cost)) continue;
    weigh(tree, object, way, best, ways);
    tree.looks += tree.nodes[way.node].children.size();
  }
  return best.node;
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
  for (std::uint32_t up = place; up != NONE; up = tree.nodes[up].parent, ++tree.looks)
    tree.nodes[up].bounds = join(tree.nodes[up].bounds, object);
}

// Builds a tree of the given objects and returns its root. Splits recursively at the median of the
// objects' centres, along the axis in which the centres extend most.
std::uint32_t add_halves(Tree& tree, std::span<const Bounds> objects,
                         std::span<std::uint32_t> items) {
  if (items.size() == 1) return add_node(tree, objects[items[0]], items[0]);
  Bounds all, middles;
  const auto twice_middle = [&](std::uint32_t i) { return objects[i].lo + objects[i].hi; };
  for (const auto i : items) {
    all = join(all, objects[i]);
    middles = join(middles, twice_middle(i));
  }
  const Vec spread = middles.hi - middles.lo;
  const int axis = spread.x >= spread.y && spread.x >= spread.z ? 0 : spread.y >= spread.z ? 1 : 2;
  const auto half = items.size() / 2;
  std::ranges::nth_element(items, items.begin() + static_cast<std::ptrdiff_t>(half), {},
                           [&](std::uint32_t i) { return std::pair(twice_middle(i)[axis], i); });
  const std::uint32_t inner = add_node(tree, all, NONE);
  for (const auto part : {items.first(half), items.subspan(half)})
    append_child(tree, inner, add_halves(tree, objects, part));
  return inner;
}

// Adds the objects from number `first` on, by median splits instead of a search for the best place
// of each object.
void add_rest(Tree& tree, std::span<const Bounds> objects, std::size_t first) {
  std::vector<std::uint32_t> items(objects.size() - first);
  std::iota(items.begin(), items.end(), static_cast<std::uint32_t>(first));
  const std::uint32_t rest = add_halves(tree, objects, items);
  const std::uint32_t both =
      add_node(tree, join(tree.nodes[tree.root].bounds, tree.nodes[rest].bounds), NONE);
  append_child(tree, both, tree.root);
  append_child(tree, both, rest);
  tree.root = both;
}

// The bounding boxes of all nodes, computed from the bounding boxes of the objects in them.
std::vector<Bounds> eval_bounds(const std::vector<Box>& boxes, std::span<const Bounds> objects) {
  std::vector<Bounds> all(boxes.size());
  for (std::size_t i = boxes.size(); i-- > 0;) {
    if (boxes[i].item != NONE) {
      all[i] = objects[boxes[i].item];
      continue;
    }
    for (std::size_t child = i + 1; child < boxes[i].skip; child = boxes[child].skip)
      all[i] = join(all[i], all[child]);
  }
  return all;
}

Bounds mix(const Bounds& a, const Bounds& b, double share) {
  return {(1 - share) * a.lo + share * b.lo, (1 - share) * a.hi + share * b.hi};
}

// Sets the boxes as they are when the shutter opens, and their displacement with the objects.
void set_motion(Hierarchy& hierarchy, std::span<const Bounds> at_open,
                std::span<const Bounds> at_close) {
  auto& boxes = hierarchy.boxes;
  const auto open = eval_bounds(boxes, at_open), close = eval_bounds(boxes, at_close);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    boxes[i].bounds = open[i];
    hierarchy.moves.push_back({close[i].lo - open[i].lo, close[i].hi - open[i].hi});
  }
}

// Expected cost of a ray, with costs as in find_place(). It is the sum over three times: shutter
// open, halfway and closed.
double eval_cost(const Hierarchy& hierarchy) {
  const auto& boxes = hierarchy.boxes;
  double cost = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (boxes[i].item != NONE) continue;
    int children = 0;
    for (std::size_t child = i + 1; child < boxes[i].skip; child = boxes[child].skip) ++children;
    const Bounds &bounds = boxes[i].bounds, &moves = hierarchy.moves[i];
    for (const double time : {0.0, 0.5, 1.0})
      cost += half_area({bounds.lo + time * moves.lo, bounds.hi + time * moves.hi}) * children;
  }
  return cost;
}

}  // namespace

Hierarchy make_hierarchy(std::span<const Bounds> objects) {
  Tree tree;
  tree.nodes.reserve(2 * objects.size());
  // Limits insertion: it takes quadratic time if many objects are in one place, because all of them
  // become children of one box.
  const std::size_t most = MOST_LOOKS + MOST_LOOKS_PER_OBJECT * objects.size();
  std::size_t inserted = 0;
  for (; inserted < objects.size() && tree.looks <= most; ++inserted)
    insert(tree, objects[inserted], static_cast<std::uint32_t>(inserted));
  if (inserted < objects.size()) add_rest(tree, objects, inserted);

  // Stores boxes depth first. Sets `skip` of a box after the boxes inside it have been stored.
  struct Step {
    std::uint32_t index;
    bool ends_box;  // true: sets `skip` of the box `index`; false: stores the node `index`
  };
  Hierarchy flat;
  flat.boxes.reserve(tree.nodes.size());
  std::vector<Step> steps;
  if (tree.root != NONE) steps.push_back({tree.root, false});
  while (!steps.empty()) {
    const auto [index, ends_box] = steps.back();
    const auto stored = static_cast<std::uint32_t>(flat.boxes.size());
    steps.pop_back();
    if (ends_box) {
      flat.boxes[index].skip = stored;
      continue;
    }
    const Node& node = tree.nodes[index];
    flat.boxes.push_back({node.bounds, 0, node.item});
    steps.push_back({stored, true});
    for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
      steps.push_back({*child, false});
  }
  return flat;
}

// Builds a hierarchy for each of three times and keeps the best one: the order of insertion
// matters, so that the best time cannot be predicted.
Hierarchy make_hierarchy(std::span<const Bounds> at_open, std::span<const Bounds> at_close) {
  Hierarchy best;
  double least = Bounds::INF;
  for (const double time : {0.5, 0.0, 1.0}) {
    std::vector<Bounds> objects;
    objects.reserve(at_open.size());
    for (std::size_t i = 0; i < at_open.size(); ++i)
      objects.push_back(mix(at_open[i], at_close[i], time));
    Hierarchy made = make_hierarchy(objects);
    set_motion(made, at_open, at_close);
    const double cost = eval_cost(made);
    if (cost < least) {
      least = cost;
      best = std::move(made);
    }
  }
  return best;
}

}  // namespace renderer

#include "topologies/draw/layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "base/errors.hpp"
#include "topologies/draw/graphviz.hpp"
#include "topologies/files/dot.hpp"
#include "topologies/route/routes.hpp"

namespace topologies {
namespace {

// Appends `count` places in `rows` rows, filled alternately from left to right and from right to
// left. Each row is evenly spaced from `left` to `left` + `width`.
void add_rows(Places& places, int count, int rows, double left, double width) {
  for (int row = 0; row < rows; ++row) {
    const int first = count * row / rows, last = count * (row + 1) / rows;
    for (int p = first; p < last; ++p) {
      const double x = last - first > 1 ? width * (p - first) / (last - first - 1) : 0;
      places.push_back({left + (row % 2 ? width - x : x), -1.5 * row});
    }
  }
}

Places make_line_places(int n) {
  constexpr int LONGEST = 16;
  const int rows = (n + LONGEST - 1) / LONGEST;
  Places places;
  add_rows(places, n, rows, 0, 1.4 * std::max(0, (n + rows - 1) / rows - 1));
  return places;
}

Places make_circle(int n) {
  const double radius = 1.4 * n / (2 * std::numbers::pi);
  Places places;
  for (int p = 0; p < n; ++p) {
    const double angle = std::numbers::pi / 2 - 2 * std::numbers::pi * p / n;
    places.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return places;
}

// Places a large ring as an even number of rows, traversed alternately in both directions. A column
// of processors on the left leads from the last row back to the first.
Places make_ring_places(int n) {
  constexpr int LARGEST_CIRCLE = 36;
  if (n <= LARGEST_CIRCLE) return make_circle(n);
  const int rows = 2 * static_cast<int>(std::sqrt(n) / 2);
  Places places;
  add_rows(places, n - rows, rows, 1.4, 1.4 * ((n - 1) / rows - 1));
  for (int row = rows - 1; row >= 0; --row) places.push_back({0, -1.5 * row});
  return places;
}

template <typename Column, typename Row>
Places make_grid(int n, double spacing, Column column, Row row) {
  Places places;
  for (int p = 0; p < n; ++p) places.push_back({spacing * column(p), -spacing * row(p)});
  return places;
}

// The processors of each level of the tree, indexed by their distance from the root. Within a
// level, children follow the order of their parents.
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

// The horizontal position of each processor, indexed by its number: midway between the first and
// last leaf of the processor's subtree. The leaves have the positions 0, 1, 2 and so on, from left
// to right.
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

// Places each level of the tree on a circle around the root. `turns` gives each processor's angle
// as a fraction of a full turn, clockwise from the top. If a level has too many processors for one
// circle, they alternate between two radii.
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

// Places processors by the spanning tree from the root. Small trees grow downwards from the root;
// all other topologies are drawn as circles around it, with a gap above the root.
Places make_tree_places(const Topology& topology) {
  const auto tree = make_spanning_tree(topology, topology.root);
  auto middles = make_middles(tree);
  const double leaves = std::ranges::max(middles) + 1;
  constexpr double WIDEST = 32;
  if (leaves > WIDEST || !is_tree(topology)) {
    for (double& middle : middles) middle = (middle + 2) / (leaves + 3);
    return make_rings(tree, middles);
  }
  Places places;
  for (int p = 0; p < topology.processors; ++p)
    places.push_back({1.1 * middles[p], -1.8 * tree.depth[p]});
  return places;
}

// Rotates all places about their centroid until `root` is directly above the centroid.
void turn_upwards(Places& places, int root) {
  Place middle;
  for (const auto& [x, y] : places) middle.x += x, middle.y += y;
  middle.x /= static_cast<double>(places.size()), middle.y /= static_cast<double>(places.size());
  const double dx = places[root].x - middle.x, dy = places[root].y - middle.y;
  const double length = std::hypot(dx, dy);
  if (length < 0.01) return;
  for (auto& place : places) {
    const double x = place.x - middle.x, y = place.y - middle.y;
    place = {(x * dy - y * dx) / length, (x * dx + y * dy) / length};
  }
}

// Enlarges a drawing whose shortest link has no room for the port numbers of its ends.
void lengthen_links(const Topology& topology, Places& places) {
  // Shortest link in units of the layout; largest factor of enlargement.
  constexpr double SHORTEST = 1.7, MOST = 2;
  double shortest = SHORTEST;
  for (const auto& [a, b] : topology.links)
    shortest = std::min(shortest, std::hypot(places[a.processor].x - places[b.processor].x,
                                             places[a.processor].y - places[b.processor].y));
  const double factor = std::min(MOST, SHORTEST / shortest);
  for (auto& place : places) place = {factor * place.x, factor * place.y};
}

Places make_found_places(const Topology& topology) {
  Topology numbered = topology;
  numbered.labels.clear();
  std::istringstream lines(run_graphviz(
      topology.processors > 300 ? "sfdp" : "neato",
      {"-Tplain", "-Gstart=1", "-Gsep=+8", "-Goverlap=scale", "-Nwidth=0.5", "-Nfixedsize=true"},
      to_dot(numbered), topology.name));
  Places places(topology.processors);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string kind;
    size_t p = 0;
    Place place;
    if (words >> kind && kind == "node" && words >> p >> place.x >> place.y)
      places.at(p) = {1.6 * place.x, 1.6 * place.y};
  }
  lengthen_links(topology, places);
  turn_upwards(places, topology.root);
  return places;
}

// The offset of each link's midpoint from the straight line, for the links of a grid. Links between
// adjacent processors stay straight. Longer links, which would cross other processors, bend
// sideways.
Places make_swerves(const Topology& topology, const Places& places, double spacing) {
  std::vector<Place> swerves(topology.links.size());
  for (size_t i = 0; i < swerves.size(); ++i) {
    const auto& [a, b] = topology.links[i];
    const double dx = places[b.processor].x - places[a.processor].x;
    const double dy = places[b.processor].y - places[a.processor].y;
    if (std::abs(dx) > 1.5 * spacing) swerves[i].y = -spacing / 2;
    if (std::abs(dy) > 1.5 * spacing) swerves[i].x = spacing / 2;
  }
  return swerves;
}

// Spreads parallel links (links between the same two processors) to both sides of the straight line
// between the processors.
void part_parallel_links(const Topology& topology, Layout& layout) {
  constexpr double APART = 0.3;
  const auto& links = topology.links;
  for (size_t first = 0, last = 0; first < links.size(); first = last) {
    const int a = links[first].a.processor, b = links[first].b.processor;
    while (last < links.size() && links[last].a.processor == a && links[last].b.processor == b)
      ++last;
    const Place &from = layout.processors[a], &to = layout.processors[b];
    const double dx = to.x - from.x, dy = to.y - from.y, length = std::hypot(dx, dy);
    for (size_t i = first; i < last; ++i) {
      const double off =
          APART * (static_cast<double>(i) - static_cast<double>(first + last - 1) / 2);
      if (off == 0) continue;
      layout.swerves[i].x -= off * dy / length;
      layout.swerves[i].y += off * dx / length;
    }
  }
}

// The smallest distance from a link's curve to any processor other than the link's two ends.
double find_clearance(const Places& places, const Link& link, const Place& swerve) {
  constexpr int SAMPLES = 24;
  const auto curve = make_curve(places[link.a.processor], places[link.b.processor], swerve);
  double nearest = INFINITY;
  for (int i = 1; i < SAMPLES; ++i) {
    const auto [x, y] = eval_curve(curve, double(i) / SAMPLES);
    for (std::size_t p = 0; p < places.size(); ++p)
      if (static_cast<int>(p) != link.a.processor && static_cast<int>(p) != link.b.processor)
        nearest = std::min(nearest, std::hypot(places[p].x - x, places[p].y - y));
  }
  return nearest;
}

// Bends each link that would run through a third processor, no further than necessary.
void avoid_processors(const Topology& topology, Layout& layout) {
  constexpr double CLEAR = 0.55;  // in units of the layout; the radius of a processor is 0.375
  for (std::size_t i = 0; i < topology.links.size(); ++i) {
    const auto& link = topology.links[i];
    const Place &from = layout.processors[link.a.processor],
                &to = layout.processors[link.b.processor];
    const double dx = to.x - from.x, dy = to.y - from.y, length = std::hypot(dx, dy);
    double most = find_clearance(layout.processors, link, {});
    for (int step = 1; step <= 8 && most < CLEAR; ++step)
      for (const double side : {0.25, -0.25}) {
        const Place swerve{-side * step * dy / length, side * step * dx / length};
        const double clearance = find_clearance(layout.processors, link, swerve);
        if (clearance <= most) continue;
        most = clearance;
        layout.swerves[i] = swerve;
      }
  }
}

// Decodes a two-bit Gray code: maps 00, 01, 11, 10 to 0, 1, 2, 3.
int from_gray(int bits) { return bits ^ (bits >> 1); }

}  // namespace

std::array<Place, 4> make_curve(const Place& from, const Place& to, const Place& swerve) {
  const Place off{4 * swerve.x / 3, 4 * swerve.y / 3};
  return {from, {from.x + off.x, from.y + off.y}, {to.x + off.x, to.y + off.y}, to};
}

Place eval_curve(const std::array<Place, 4>& curve, double t) {
  const double s = 1 - t;
  const auto mix = [&](double Place::*axis) {
    return s * s * s * curve[0].*axis + 3 * s * s * t * curve[1].*axis +
           3 * s * t * t * curve[2].*axis + t * t * t * curve[3].*axis;
  };
  return {mix(&Place::x), mix(&Place::y)};
}

std::array<Place, 4> make_half_curve(const Place& from, const Place& to, const Place& swerve) {
  const auto mix = [](const Place& a, const Place& b) {
    return Place{(a.x + b.x) / 2, (a.y + b.y) / 2};
  };
  const auto [p0, p1, p2, p3] = make_curve(from, to, swerve);
  const Place p01 = mix(p0, p1), p12 = mix(p1, p2), p23 = mix(p2, p3), p012 = mix(p01, p12);
  return {p0, p01, p012, mix(p012, mix(p12, p23))};
}

Layout make_layout(const Topology& topology) {
  constexpr double SPACING = 1.6;
  constexpr int MAX_FOUND = 1024;  // Graphviz places this many processors in one or two seconds
  const int n = topology.processors;
  base::require(n <= MAX_DRAWN, "topology " + topology.name,
                "found {} processors, expected at most {} in a drawing (formats dot, graphml and "
                "csv have no limit)",
                n, MAX_DRAWN);
  const auto [form, rows, columns] = topology.shape;
  using Form = Shape::Form;
  Layout layout{{}, std::vector<Place>(topology.links.size())};
  if (form == Form::grid && rows * columns == n) {
    layout.processors = make_grid(
        n, SPACING, [&](int p) { return p % columns; }, [&](int p) { return p / columns; });
    layout.swerves = make_swerves(topology, layout.processors, SPACING);
  } else if (form == Form::hypercube) {
    layout.processors = make_grid(
        n, SPACING, [](int p) { return from_gray(p & 3); },
        [](int p) { return from_gray(p >> 2); });
    layout.swerves = make_swerves(topology, layout.processors, SPACING);
  } else if (form == Form::line) {
    layout.processors = make_line_places(n);
  } else if (form == Form::ring) {
    layout.processors = make_ring_places(n);
  } else if (form == Form::around_root || is_tree(topology) || n > MAX_FOUND) {
    layout.processors = make_tree_places(topology);
  } else {
    layout.processors = make_found_places(topology);
    avoid_processors(topology, layout);
  }
  part_parallel_links(topology, layout);
  return layout;
}

}  // namespace topologies

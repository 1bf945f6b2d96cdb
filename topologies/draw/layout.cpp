#include "topologies/draw/layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "topologies/draw/graphviz.hpp"
#include "topologies/files/formats.hpp"

namespace topologies {
namespace {

// Processors `first` .. `first + count - 1` in rows to and fro, evenly in each, columns 0 .. width.
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

// Large rings: an even number of rows to and fro, and back up on the left.
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

// Turned about their middle until `root` is above it.
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

Places make_found_places(const Topology& topology) {
  Topology numbered = topology;
  numbered.labels.clear();
  const char* program = topology.processors > 300 ? "sfdp" : "neato";
  std::istringstream lines(run_graphviz(
      fmt::format("{} -Tplain -Gstart=1 -Gsep=+8 -Goverlap=scale -Nwidth=0.5 -Nfixedsize=true",
                  program),
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
  turn_upwards(places, topology.root);
  return places;
}

// A grid's links run along its lines; those that pass over others run beside them.
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

// Of a mesh or torus by its name; 0 of others.
int grid_columns(const Topology& topology, const std::string& kind) {
  if (kind != "mesh" && kind != "torus") return 0;
  int rows = 0, columns = 0;
  char x = 0;
  std::istringstream(topology.name.substr(kind.size() + 1)) >> rows >> x >> columns;
  return rows * columns == topology.processors ? columns : 0;
}

int from_gray(int bits) { return bits ^ (bits >> 1); }  // of two bits: 00 01 11 10 are 0 1 2 3

}  // namespace

Layout make_layout(const Topology& topology) {
  constexpr double SPACING = 1.6;
  const int n = topology.processors;
  const auto kind = topology.name.substr(0, topology.name.find(':'));
  const bool is_tree = static_cast<int>(topology.links.size()) == n - 1;
  const int columns = grid_columns(topology, kind);
  Layout layout{{}, std::vector<Place>(topology.links.size())};
  if (columns > 0) {
    layout.processors = make_grid(
        n, SPACING, [&](int p) { return p % columns; }, [&](int p) { return p / columns; });
    layout.swerves = make_swerves(topology, layout.processors, SPACING);
  } else if (kind == "hypercube") {
    layout.processors = make_grid(
        n, SPACING, [](int p) { return from_gray(p & 3); },
        [](int p) { return from_gray(p >> 2); });
    layout.swerves = make_swerves(topology, layout.processors, SPACING);
  } else if (kind == "line") {
    layout.processors = make_line_places(n);
  } else if (kind == "ring") {
    layout.processors = make_ring_places(n);
  } else if (kind == "amp" || is_tree) {
    layout.processors = make_tree_places(topology);
  } else {
    layout.processors = make_found_places(topology);
  }
  return layout;
}

}  // namespace topologies

#include "topologies/graph/grid.hpp"

#include <algorithm>
#include <cstdlib>

namespace topologies {
namespace {

// Number of links along one axis. A closed axis of two places has one link, not two.
std::int64_t count_links(const Axis& axis) {
  return axis.closed && axis.size > 2 ? axis.size : axis.size - 1;
}

bool is_grid(const Topology& topology, const Grid& grid) {
  const auto expected =
      grid.down.size * count_links(grid.along) + grid.along.size * count_links(grid.down);
  return static_cast<std::int64_t>(topology.links.size()) == expected &&
         distinct_links(topology).size() == topology.links.size() &&
         std::ranges::all_of(topology.links, [&](const Link& link) {
           return grid.distance(link.a.processor, link.b.processor) == 1;
         });
}

// The numbers of rows and columns that the topology's shape states, still to be verified. If the
// shape is not a grid of the right size, returns a single row.
std::pair<int, int> find_sizes(const Topology& topology) {
  const auto& [form, rows, columns] = topology.shape;
  const bool fits =
      form == Shape::Form::grid && static_cast<std::int64_t>(rows) * columns == topology.processors;
  return fits ? std::pair{rows, columns} : std::pair{1, topology.processors};
}

// True if renumbering processors by the permutation `shift` maps each link to a link with the same
// ports.
template <typename Shift>
bool keeps(const Peers& peers, Shift shift) {
  for (int p = 0; p < static_cast<int>(peers.size()); ++p)
    for (int port = 0; port < PORTS; ++port)
      if (peers[shift(p)][port] != shift(peers[p][port])) return false;
  return true;
}

}  // namespace

int Axis::distance(int a, int b) const {
  const int apart = std::abs(a - b);
  return closed ? std::min(apart, size - apart) : apart;
}

int Axis::diameter() const { return closed ? size / 2 : size - 1; }

std::int64_t Axis::sum_of_distances() const {
  const std::int64_t n = size;
  return closed ? n * (n * n / 4) : n * (n * n - 1) / 3;
}

int Grid::distance(int a, int b) const {
  return down.distance(a / along.size, b / along.size) +
         along.distance(a % along.size, b % along.size);
}

std::int64_t Grid::sum_of_distances() const {
  const std::int64_t rows = down.size, columns = along.size;
  return columns * columns * down.sum_of_distances() + rows * rows * along.sum_of_distances();
}

std::optional<Grid> find_grid(const Topology& topology) {
  const auto [rows, columns] = find_sizes(topology);
  for (const bool closed_down : {false, true})
    for (const bool closed_along : {false, true}) {
      const Grid grid{{rows, closed_down}, {columns, closed_along}};
      if (is_grid(topology, grid)) return grid;
    }
  return {};
}

Orbits find_orbits(const Topology& topology) {
  const auto [rows, columns] = find_sizes(topology);
  const int n = topology.processors, width = columns;
  const auto peers = make_peers(topology);
  Orbits orbits{rows, columns, rows, columns};
  if (keeps(peers, [&](int p) { return (p + width) % n; })) orbits.rows = 1;
  if (keeps(peers, [&](int p) { return p - p % width + (p + 1) % width; })) orbits.columns = 1;
  return orbits;
}

}  // namespace topologies

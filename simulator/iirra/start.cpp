// The assignments made before the first task: roles of processors, and initial cells of workers.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "simulator/iirra/iirra.hpp"
#include "topologies/route/routes.hpp"

namespace iirra {

namespace {

// Returns the position of a cell on a Z-order curve. Cells with close positions are mostly close in
// the image.
std::uint64_t place_on_curve(int column, int row) {
  std::uint64_t place = 0;
  for (int bit = 0; bit < 16; ++bit)
    place |= static_cast<std::uint64_t>(column >> bit & 1) << (2 * bit) |
             static_cast<std::uint64_t>(row >> bit & 1) << (2 * bit + 1);
  return place;
}

}  // namespace

Places find_places(const topologies::Topology& topology, bool is_far) {
  const int n = topology.processors;
  base::require(
      n >= SERVICES + 1, "network.topology",
      "found {} processor{}, expected at least {} (a coordinator, a display and a worker)", n,
      n == 1 ? "" : "s", SERVICES + 1);
  Places places;
  places.coordinator = topology.root;
  const auto tree = topologies::make_spanning_tree(topology, topology.root);
  places.display = -1;
  for (int id = 0; id < n; ++id) {
    if (id == places.coordinator) continue;
    const int best = places.display < 0 ? (is_far ? -1 : n) : tree.depth[places.display];
    if (is_far ? tree.depth[id] > best : tree.depth[id] < best) places.display = id;
  }
  for (int id = 0; id < n; ++id)
    if (id != places.coordinator && id != places.display) places.workers.push_back(id);
  return places;
}

std::vector<SampledCell> make_cells(const renderer::Area& area, int side) {
  std::vector<SampledCell> cells;
  for (int y = area.y; y < area.y + area.height; y += side)
    for (int x = area.x; x < area.x + area.width; x += side) cells.push_back({x, y, side, 0});
  return cells;
}

std::vector<int> assign(Start start, int columns, int rows, int workers) {
  const auto cells = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  std::vector<int> worker_of(cells);
  if (start == Start::blocks) {
    std::vector<std::size_t> order(cells);
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto place = [columns](std::size_t cell) {
      const int i = static_cast<int>(cell);
      return place_on_curve(i % columns, i / columns);
    };
    std::ranges::sort(order, {}, place);
    for (std::size_t i = 0; i < cells; ++i)
      worker_of[order[i]] = static_cast<int>(i * static_cast<std::size_t>(workers) / cells);
    return worker_of;
  }
  // Divides the image into macro-cells. A macro-cell is a block of adjacent cells with one cell for
  // each worker, and is as square as the number of workers allows. If a macro-cell has more cells
  // than workers, the surplus cells go to the workers in rotation.
  const int down = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(workers))));
  const int across = (workers + down - 1) / down;
  int turn = 0;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const int place = row % down * across + column % across;
      worker_of[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                static_cast<std::size_t>(column)] = place < workers ? place : turn++ % workers;
    }
  return worker_of;
}

}  // namespace iirra

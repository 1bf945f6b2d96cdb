// The roles of processors, and the initial assignment of cells to workers.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

#include "base/errors.hpp"
#include "simulator/iirra/iirra.hpp"
#include "tests/topologies/support.hpp"
#include "topologies/make/generators.hpp"

namespace iirra {
namespace {

// Figure 5.24 of the thesis shows 16 x 16 cells on 16 processors, which it counts from 1.
TEST(IirraStart, ScattersAsInFigure524) {
  const auto worker_of = assign(Start::scattered, 16, 16, 16);
  ASSERT_EQ(worker_of.size(), 256u);
  const int macro_cell[4][4] = {{1, 2, 3, 4}, {5, 6, 7, 8}, {9, 10, 11, 12}, {13, 14, 15, 16}};
  for (std::size_t row = 0; row < 16; ++row)
    for (std::size_t column = 0; column < 16; ++column)
      EXPECT_EQ(worker_of[16 * row + column] + 1, macro_cell[row % 4][column % 4])
          << row << " " << column;
}

std::vector<int> count_cells(const std::vector<int>& worker_of, int workers) {
  std::vector<int> counts(static_cast<std::size_t>(workers));
  for (const int worker : worker_of) ++counts.at(static_cast<std::size_t>(worker));
  return counts;
}

// The image consists of whole macro-cells (groups of adjacent cells, one for each worker). Surplus
// cells of macro-cells must go to the workers in rotation.
TEST(IirraStart, EveryWorkerHasItsShare) {
  std::mt19937_64 random(20261123);
  for (int round = 0; round < 200; ++round) {
    const int workers = 1 + static_cast<int>(random() % 60);
    const int down = std::max(1, static_cast<int>(std::sqrt(workers)));
    const int across = (workers + down - 1) / down;
    const int columns = across * (1 + static_cast<int>(random() % 4));
    const int rows = down * (1 + static_cast<int>(random() % 4));
    SCOPED_TRACE(testing::Message() << workers << " workers, " << columns << " x " << rows);
    const auto counts = count_cells(assign(Start::scattered, columns, rows, workers), workers);
    const auto [least, most] = std::ranges::minmax(counts);
    EXPECT_GE(least, 1);
    EXPECT_LE(most - least, 1);
  }
}

// The right or lower border of the image cuts off some macro-cells; these have no cell for some
// workers. Numbers of cells may differ by little more than the number of such macro-cells on a
// border.
TEST(IirraStart, ScatteringIsNearlyEvenInAnyImage) {
  std::mt19937_64 random(20261124);
  for (int round = 0; round < 200; ++round) {
    const int workers = 1 + static_cast<int>(random() % 60);
    const int columns = 1 + static_cast<int>(random() % 70);
    const int rows = 1 + static_cast<int>(random() % 70);
    SCOPED_TRACE(testing::Message() << workers << " workers, " << columns << " x " << rows);
    const auto counts = count_cells(assign(Start::scattered, columns, rows, workers), workers);
    const double side = std::floor(std::sqrt(workers));
    const auto [least, most] = std::ranges::minmax(counts);
    EXPECT_LE(most - least, columns / side + rows / side + 3);
  }
}

// Each worker must get as many adjacent cells as the others. A section of the Z-order curve has at
// most two connected pieces inside a square whose side is a power of two.
TEST(IirraStart, BlocksArePiecesOfTheImage) {
  for (const int side : {8, 16, 32})
    for (const int workers : {1, 2, 3, 4, 7, 13, 16, 33, 64}) {
      SCOPED_TRACE(testing::Message() << workers << " workers, side " << side);
      const auto worker_of = assign(Start::blocks, side, side, workers);
      const auto counts = count_cells(worker_of, workers);
      const auto [least, most] = std::ranges::minmax(counts);
      EXPECT_GE(least, 1);
      EXPECT_LE(most - least, 1);
      std::vector<bool> seen(worker_of.size());
      std::vector<int> pieces(static_cast<std::size_t>(workers));
      for (int start = 0; start < side * side; ++start) {
        if (seen[static_cast<std::size_t>(start)]) continue;
        const int worker = worker_of[static_cast<std::size_t>(start)];
        ++pieces[static_cast<std::size_t>(worker)];
        for (std::vector<int> stack{start}; !stack.empty();) {
          const int cell = stack.back();
          stack.pop_back();
          const auto at = static_cast<std::size_t>(cell);
          if (seen[at] || worker_of[at] != worker) continue;
          seen[at] = true;
          if (cell % side > 0) stack.push_back(cell - 1);
          if (cell % side < side - 1) stack.push_back(cell + 1);
          if (cell >= side) stack.push_back(cell - side);
          if (cell < side * (side - 1)) stack.push_back(cell + side);
        }
      }
      EXPECT_LE(std::ranges::max(pieces), 2);
    }
}

TEST(IirraStart, BlocksOfFourWorkersAreQuarters) {
  const auto worker_of = assign(Start::blocks, 8, 8, 4);
  for (std::size_t i = 0; i < 64; ++i)
    EXPECT_EQ(worker_of[i], static_cast<int>(i / 32 * 2 + i % 8 / 4)) << i;
}

TEST(IirraStart, CellsTileTheArea) {
  for (const renderer::Area area : {renderer::Area{0, 0, 32, 16}, {3, 5, 33, 17}, {1, 0, 7, 9}})
    for (const int side : {2, 4, 8}) {
      std::vector<int> covered(60 * 60);
      for (const auto& cell : make_cells(area, side)) {
        EXPECT_EQ(cell.side, side);
        EXPECT_EQ(cell.level, 0);
        bool has_pixel = false;
        for (int y = cell.y; y < cell.y + side; ++y)
          for (int x = cell.x; x < cell.x + side; ++x) {
            ++covered[static_cast<std::size_t>(60 * y + x)];
            has_pixel |= x < area.x + area.width && y < area.y + area.height;
          }
        EXPECT_TRUE(has_pixel);
      }
      for (int y = area.y; y < area.y + area.height; ++y)
        for (int x = area.x; x < area.x + area.width; ++x)
          EXPECT_EQ(covered[static_cast<std::size_t>(60 * y + x)], 1);
    }
}

// --- roles --------------------------------------------------------------------------------------

void expect_places(const topologies::Topology& topology) {
  const auto distances = topologies::plain_distances(topology, topology.root);
  for (const bool is_far : {true, false}) {
    const auto places = find_places(topology, is_far);
    EXPECT_EQ(places.coordinator, topology.root);
    ASSERT_NE(places.display, topology.root);
    const int distance = distances.at(static_cast<std::size_t>(places.display));
    EXPECT_EQ(distance, is_far ? std::ranges::max(distances) : 1);
    std::set<int> all(places.workers.begin(), places.workers.end());
    EXPECT_EQ(all.size(), static_cast<std::size_t>(topology.processors - 2));
    EXPECT_TRUE(std::ranges::is_sorted(places.workers));
    all.insert({places.coordinator, places.display});
    EXPECT_EQ(all.size(), static_cast<std::size_t>(topology.processors));
  }
}

TEST(IirraStart, TheDisplayIsFarOrNear) {
  for (const char* spec : {"line:3", "line:9", "ring:8", "mesh:4x4", "torus:3x5", "tree:13",
                           "hypercube:3", "amp:9", "amp:23"}) {
    SCOPED_TRACE(spec);
    expect_places(topologies::make_topology(spec));
  }
  for (unsigned seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const auto topology = topologies::random_topology(seed);
    if (topology.processors >= 3) expect_places(topology);
  }
}

TEST(IirraStart, NeedsThreeProcessors) {
  for (const char* spec : {"line:1", "line:2"})
    EXPECT_EQ(topologies::rejection([&] { find_places(topologies::make_topology(spec), true); }),
              fmt::format("network.topology: found {}, expected at least 3 (a coordinator, a "
                          "display and a worker)",
                          std::string(spec) == "line:1" ? "1 processor" : "2 processors"));
}

}  // namespace
}  // namespace iirra

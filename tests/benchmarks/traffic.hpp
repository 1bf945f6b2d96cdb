#pragma once
// The messages of the benchmarks, the same for all simulators: along a line, and between
// pseudo-random nodes of an 8 x 8 mesh. In the mesh, a message goes along its row first, and then
// along the column (dimension-order routing).
#include <array>
#include <cstdint>
#include <vector>

namespace benchmarks {

inline constexpr std::uint64_t MESSAGE_BYTES = 80;
inline constexpr int LINE_HOPS = 4;
inline constexpr int LINE_MESSAGES = 40'000;
inline constexpr int SIDE = 8, NODES = SIDE * SIDE;
inline constexpr int MESSAGES_PER_NODE = 250;
inline constexpr int DIRECTIONS = 4;  // east, west, south and north

// The neighbour of `node` in a direction, or -1 at the edge of the mesh.
inline int neighbour(int node, int direction) {
  const int x = node % SIDE + std::array{1, -1, 0, 0}[direction];
  const int y = node / SIDE + std::array{0, 0, 1, -1}[direction];
  return x < 0 || x >= SIDE || y < 0 || y >= SIDE ? -1 : y * SIDE + x;
}
inline int opposite(int direction) { return direction ^ 1; }

// The direction in which a message for `destination` leaves `node`.
inline int route(int node, int destination) {
  const int dx = destination % SIDE - node % SIDE, dy = destination / SIDE - node / SIDE;
  return dx != 0 ? (dx > 0 ? 0 : 1) : (dy > 0 ? 2 : 3);
}

struct Traffic {
  // for each node, the destinations of its messages, in order
  std::vector<std::vector<int>> destinations{NODES};
  // for each node, the numbers of messages that leave it in each direction. The node's processes
  // count down these numbers to know when they have finished.
  std::vector<std::array<int, DIRECTIONS>> leaving{NODES};
  // for each node, the number of messages that arrive
  std::vector<int> arriving = std::vector<int>(NODES);
  std::uint64_t hops = 0;
};

inline Traffic make_traffic() {
  Traffic traffic;
  std::uint64_t state = 1;
  for (int source = 0; source < NODES; ++source)
    for (int i = 0; i < MESSAGES_PER_NODE; ++i) {
      state = state * 6364136223846793005u + 1442695040888963407u;
      const int to = (source + 1 + static_cast<int>((state >> 33) % (NODES - 1))) % NODES;
      traffic.destinations[source].push_back(to);
      ++traffic.arriving[to];
      for (int node = source; node != to; node = neighbour(node, route(node, to))) {
        ++traffic.leaving[node][route(node, to)];
        ++traffic.hops;
      }
    }
  return traffic;
}

}  // namespace benchmarks

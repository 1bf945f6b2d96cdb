#pragma once
// Messages of the benchmarks, equal for all simulators: along a line, and between pseudo-random
// nodes of an 8 x 8 mesh. In the mesh they go along the row first, then along the column (dimension
// order).
#include <array>
#include <cstdint>
#include <vector>

namespace benchmarks {

inline constexpr std::uint64_t MESSAGE_BYTES = 80;
inline constexpr int LINE_HOPS = 4;
inline constexpr int LINE_MESSAGES = 40'000;
inline constexpr int SIDE = 8, NODES = SIDE * SIDE;
inline constexpr int MESSAGES_PER_NODE = 250;
inline constexpr int DIRECTIONS = 4;  // number of directions: east, west, south, north

// The neighbour of `node` in a direction, or -1 at the edge.
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
  // destinations of each node's messages, in order
  std::vector<std::vector<int>> destinations{NODES};
  // Number of messages that leave each node in each direction, so that a process knows when it is
  // done.
  std::vector<std::array<int, DIRECTIONS>> leaving{NODES};
  std::vector<int> arriving = std::vector<int>(NODES);  // number of messages for each node
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

#include "topologies/route/grid_rule.hpp"

#include <algorithm>

namespace topologies {
namespace {

// Sample destinations on one axis for add_turns(). A turn is a pair of successive ports on a route.
// Take any route to any destination: the turns that it makes at place `at`, and at the neighbours
// of this place, also occur on routes to the samples.
std::vector<int> find_witnesses(const Axis& axis, int at) {
  constexpr int BESIDE = 3;
  std::vector<int> places;
  for (const int middle : {at, at + axis.size / 2})
    for (int off = -BESIDE; off <= BESIDE; ++off) {
      const int place = middle + off;
      if (axis.closed)
        places.push_back((place % axis.size + axis.size) % axis.size);
      else if (middle == at && place >= 0 && place < axis.size)
        places.push_back(place);
    }
  std::ranges::sort(places);
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
}

}  // namespace

int GridRule::next_port(int from, int to) const {
  return find_port(from, to, [](int) { return true; });
}

int XyRule::next_port(int from, int to) const {
  const int columns = grid().along.size;
  // True if the destination is in another column, so that the message first goes along the row.
  const bool along = from % columns != to % columns;
  return find_port(from, to, [&](int peer) { return !along || peer / columns == from / columns; });
}

RouteSum GridRule::sum() const {
  const std::int64_t n = processors();
  return {grid_.sum_of_distances(), n * (n - 1)};
}

void GridRule::add_turns(Turns& turns, int first, int /*last*/) const {
  if (first > 0) return;  // the call with first == 0 adds all turns
  const int columns = grid_.along.size;
  for (int at = 0; at < processors(); ++at) {
    const auto along = find_witnesses(grid_.along, at % columns);
    for (const int row : find_witnesses(grid_.down, at / columns))
      for (const int column : along) {
        const int to = row * columns + column;
        if (at == to) continue;
        const int port = next_port(at, to), next = peers()[at][port];
        if (next != to) turns[at * PORTS + port] |= 1U << next_port(next, to);
      }
  }
}

}  // namespace topologies

#include "experiments/laboratory/places/places.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace laboratory {

namespace {

using topologies::Place;

// If the machine has more processors than this, each processor gets the first position beside its
// neighbour, without a search for a free one.
constexpr std::size_t MOST_COMPARED = 2048;
// Positions to try for a processor, relative to its neighbour; y points upwards.
constexpr Place BESIDE[] = {{0, 1}, {-1, 1},     {1, 1},     {-1, 0},
                            {1, 0}, {-0.5, 0.5}, {0.5, 0.5}, {0, -1}};

double nearest(const SomePlaces& places, const Place& to) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& place : places)
    if (place) least = std::min(least, std::hypot(place->x - to.x, place->y - to.y));
  return least;
}

Place find_free(const SomePlaces& places, const Place& beside) {
  const auto go = [&](const Place& step) { return Place{beside.x + step.x, beside.y + step.y}; };
  Place best = go(BESIDE[0]);
  if (places.size() > MOST_COMPARED) return best;
  double best_distance = nearest(places, best);
  for (const auto& step : BESIDE) {
    const Place place = go(step);
    const double distance = std::min(1.0, nearest(places, place));
    if (distance > best_distance + 1e-9) {
      best = place;
      best_distance = distance;
    }
  }
  return best;
}

}  // namespace

int find_id(const std::vector<int>& network, int processor) {
  return network.empty() ? processor : network.at(static_cast<std::size_t>(processor));
}

topologies::Places place_others(const machine::Machine& machine, SomePlaces places) {
  const auto place_beside = [&](std::size_t id, std::size_t other) {
    if (places[id] || !places[other]) return false;
    places[id] = find_free(places, *places[other]);
    return true;
  };
  for (bool is_new = true; is_new;) {
    is_new = false;
    for (const auto& link : machine.links())
      is_new |= place_beside(static_cast<std::size_t>(link->to().id()),
                             static_cast<std::size_t>(link->from().id()));
    for (const auto& processor : machine.processors())
      if (const auto* companion = processor->companion())
        is_new |= place_beside(static_cast<std::size_t>(processor->id()),
                               static_cast<std::size_t>(companion->id()));
  }
  topologies::Places all;
  double x = 0;
  for (const auto& place : places) all.push_back(place ? *place : Place{x++, -1});
  return all;
}

topologies::Places place_processors(const machine::Machine& machine,
                                    const topologies::Topology& topology,
                                    const std::vector<int>& network) {
  const std::size_t n = machine.processors().size();
  SomePlaces places(n);
  if (topology.processors > 1 || n == 1) {
    const auto layout = topologies::make_layout(topology);
    for (std::size_t i = 0; i < layout.processors.size(); ++i) {
      const std::size_t id = i < network.size() ? static_cast<std::size_t>(network[i]) : i;
      if (id < n) places[id] = layout.processors[i];
    }
  } else {
    places[static_cast<std::size_t>(find_id(network, 0))] = Place{};
  }
  return place_others(machine, std::move(places));
}

}  // namespace laboratory

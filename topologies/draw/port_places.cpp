#include "topologies/draw/port_places.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace topologies {
namespace {

using Curve = std::array<Place, 4>;

double distance(const Place& a, const Place& b) { return std::hypot(a.x - b.x, a.y - b.y); }

// The place at a distance of `along` units from the first end of a curve, moved by `aside` units to
// the left of the curve.
Place place_beside(const Curve& curve, double along, double aside) {
  const Place from = curve[0], to = eval_curve(curve, 0.25);
  const double length = distance(from, to), x = (to.x - from.x) / length,
               y = (to.y - from.y) / length;
  return {from.x + along * x - aside * y, from.y + along * y + aside * x};
}

// Discs (processors and port numbers) that further port numbers should not overlap. The discs are
// stored by squares of one unit, so that a search visits only near ones.
class Crowd {
 public:
  void add(const Place& at, double radius) { squares_[key(at.x, at.y)].push_back({at, radius}); }
  // The depth by which each stored disc overlaps the disc around `at`, summed over the stored
  // discs.
  double eval_overlap(const Place& at, double radius) const {
    double overlap = 0;
    for (const double dx : {-1, 0, 1})
      for (const double dy : {-1, 0, 1})
        if (const auto square = squares_.find(key(at.x + dx, at.y + dy)); square != squares_.end())
          for (const auto& [middle, its] : square->second)
            overlap += std::max(0.0, radius + its - distance(at, middle));
    return overlap;
  }

 private:
  static long key(double x, double y) {
    return std::lround(std::floor(x)) * 1'000'003 + std::lround(std::floor(y));
  }
  std::unordered_map<long, std::vector<std::pair<Place, double>>> squares_;
};

// For each processor, the curves of its links, each directed away from the processor.
std::vector<std::vector<Curve>> list_curves(const Topology& topology, const Layout& layout) {
  std::vector<std::vector<Curve>> of(static_cast<std::size_t>(topology.processors));
  for (std::size_t i = 0; i < topology.links.size(); ++i) {
    const auto& [a, b] = topology.links[i];
    const auto curve = make_curve(layout.processors[a.processor], layout.processors[b.processor],
                                  layout.swerves[i]);
    of[a.processor].push_back(curve);
    of[b.processor].push_back({curve[3], curve[2], curve[1], curve[0]});
  }
  return of;
}

// The depth by which each curve other than `own` enters the disc around `at`, summed over these
// curves. The disc is the place of a port number of the link that `own` draws.
double eval_crossing(const std::vector<Curve>& curves, const Curve& own, const Place& at,
                     double radius) {
  double depth = 0;
  for (const auto& curve : curves) {
    if (std::ranges::equal(curve, own,
                           [](const Place& a, const Place& b) { return a.x == b.x && a.y == b.y; }))
      continue;
    double nearest = INFINITY;
    for (int i = 0; i <= 40; ++i)
      nearest = std::min(nearest, distance(at, eval_curve(curve, i / 40.0)));
    depth += std::max(0.0, radius - nearest);
  }
  return depth;
}

}  // namespace

PortPlaces place_ports(const Topology& topology, const Layout& layout, double size, double radius) {
  constexpr double TOLERATED = 0.02;
  const double along = radius + size, aside = 0.72 * size;
  Crowd crowd;
  for (const auto& place : layout.processors) crowd.add(place, radius);
  const auto curves = list_curves(topology, layout);
  const auto place = [&](const Curve& curve, int processor) {
    Place best;
    double least = INFINITY;
    for (const double further : {0.0, 0.9, 1.8})
      for (const double side : {1, -1}) {
        const auto at = place_beside(curve, along + further * size, side * aside);
        const double bad =
            crowd.eval_overlap(at, 0.45 * size) +
            eval_crossing(curves[static_cast<std::size_t>(processor)], curve, at, 0.45 * size);
        if (bad < least - TOLERATED) {
          least = bad;
          best = at;
        }
      }
    crowd.add(best, 0.45 * size);
    return best;
  };
  PortPlaces places;
  for (std::size_t i = 0; i < topology.links.size(); ++i) {
    const auto& [a, b] = topology.links[i];
    const auto curve = make_curve(layout.processors[a.processor], layout.processors[b.processor],
                                  layout.swerves[i]);
    const auto first = place(curve, a.processor);
    places.push_back({first, place({curve[3], curve[2], curve[1], curve[0]}, b.processor)});
  }
  return places;
}

}  // namespace topologies

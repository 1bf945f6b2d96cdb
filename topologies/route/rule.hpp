#pragma once
// Interface of a routing rule, which determines the next port, the distance and the turns of
// routes.

#include <cstdint>
#include <vector>

#include "topologies/graph/topology.hpp"

namespace topologies {

/// Total length of some routes in links, and the number of ordered pairs that they join.
struct RouteSum {
  std::int64_t links = 0, pairs = 0;
  RouteSum& operator+=(const RouteSum& other) {
    links += other.links, pairs += other.pairs;
    return *this;
  }
};

/// The turns of routes, as sets of ports with one bit per port. The set at [processor * PORTS +
/// port] belongs to the routes that leave `processor` through `port`; it has the ports through
/// which these routes leave the next processor.
using Turns = std::vector<std::uint8_t>;

/// The routes of one topology. Each ordered pair of processors has at most one route, without
/// loops. The next port depends only on the current processor and the destination. Rules that
/// compute routes when needed keep them in a cache. Several threads may query ports and distances
/// at the same time.
class Rule {
 public:
  explicit Rule(const Topology& topology) : peers_(make_peers(topology)) {}
  virtual ~Rule() = default;

  /// The port of `from` that leads to a different processor `to`; -1 if there is no route.
  virtual int next_port(int from, int to) const = 0;
  /// Length of the route in links; -1 if there is no route. The default implementation follows the
  /// route.
  virtual int distance(int from, int to) const;
  /// Total length of the routes from all processors to `to`.
  virtual RouteSum sum_to(int to) const;
  /// Total length of all routes.
  virtual RouteSum sum() const;
  /// Adds all turns on routes to the destinations `first` to `last` - 1. An implementation may also
  /// add turns on routes to other destinations.
  virtual void add_turns(Turns& turns, int first, int last) const;

  int processors() const { return static_cast<int>(peers_.size()); }
  const Peers& peers() const { return peers_; }

 private:
  Peers peers_;
};

}  // namespace topologies

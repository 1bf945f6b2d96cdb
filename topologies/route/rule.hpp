#pragma once
// Interface of all routing rules: next port, distance, turns.

#include <cstdint>
#include <vector>

#include "topologies/graph/topology.hpp"

namespace topologies {

/// Total length of routes, and the number of ordered pairs with a route.
struct RouteSum {
  std::int64_t links = 0, pairs = 0;
  RouteSum& operator+=(const RouteSum& other) {
    links += other.links, pairs += other.pairs;
    return *this;
  }
};

/// Turns: pairs of ports that some route takes in succession. At [processor * PORTS + port]: a bit
/// for each port by which a route leaves the neighbour at `port`.
using Turns = std::vector<std::uint8_t>;

/// The routes of one topology. Each ordered pair of processors has at most one route, without
/// loops. The next port depends only on the current processor and the destination. Rules that
/// compute routes on demand cache them. Threads may query ports and distances concurrently.
class Rule {
 public:
  explicit Rule(const Topology& topology) : peers_(make_peers(topology)) {}
  virtual ~Rule() = default;

  /// The port of `from` that leads to a different processor `to`; -1 if there is no route.
  virtual int next_port(int from, int to) const = 0;
  /// Number of links on the route; -1 if there is none. The default implementation follows the
  /// route.
  virtual int distance(int from, int to) const;
  /// Total length of all routes to one processor.
  virtual RouteSum sum_to(int to) const;
  /// Total length of all routes.
  virtual RouteSum sum() const;
  /// Adds all turns on routes to the processors `first` to `last` - 1. An implementation may also
  /// add turns of routes to other processors.
  virtual void add_turns(Turns& turns, int first, int last) const;

  int processors() const { return static_cast<int>(peers_.size()); }
  const Peers& peers() const { return peers_; }

 private:
  Peers peers_;
};

}  // namespace topologies

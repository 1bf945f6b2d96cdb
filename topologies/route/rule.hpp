#pragma once
// The interface of all kinds of routes: next port, distance, turns.

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

/// At [processor * PORTS + port]: a bit for each port of the neighbour there, set if some route
/// takes both ports in a row.
using Turns = std::vector<std::uint8_t>;

/// Routes of one topology: one loop-free route from each processor to each other, so that the next
/// port depends only on processor and destination. Kinds that find routes on demand keep them.
/// Threads may query ports and distances concurrently.
class Rule {
 public:
  explicit Rule(const Topology& topology) : peers_(make_peers(topology)) {}
  virtual ~Rule() = default;

  /// The port of `from` that leads to `to`, another processor; -1 if there is no route.
  virtual int next_port(int from, int to) const = 0;
  /// Links on the route; -1 if there is none. By default walks the route.
  virtual int distance(int from, int to) const;
  /// The sum over all routes to one processor.
  virtual RouteSum sum_to(int to) const;
  /// The sum over all routes.
  virtual RouteSum sum() const;
  /// Adds all turns on routes to the processors `first` to `last` - 1; may add turns of other
  /// routes.
  virtual void add_turns(Turns& turns, int first, int last) const;

  int processors() const { return static_cast<int>(peers_.size()); }
  const Peers& peers() const { return peers_; }

 private:
  Peers peers_;
};

}  // namespace topologies

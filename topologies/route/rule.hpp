#pragma once
// What every kind of routes can tell: where a message goes next, how far it is, where it turns.

#include <cstdint>
#include <vector>

#include "topologies/graph/topology.hpp"

namespace topologies {

/// Lengths of routes, added up over ordered pairs of processors that have a way.
struct RouteSum {
  std::int64_t links = 0, pairs = 0;
  RouteSum& operator+=(const RouteSum& other) {
    links += other.links, pairs += other.pairs;
    return *this;
  }
};

/// At [processor * PORTS + port] a bit for each port by which some route that leaves the processor
/// there leaves the neighbour next.
using Turns = std::vector<std::uint8_t>;

/// Routes of one topology: from each processor one way to each other, the same for all messages
/// that come by. None is a loop. Kinds that find routes as they are asked for keep what they have
/// found. Threads may ask side by side for ports and distances.
class Rule {
 public:
  explicit Rule(const Topology& topology) : peers_(make_peers(topology)) {}
  virtual ~Rule() = default;

  /// The port of `from` that leads to `to`, another processor; -1 if there is no way.
  virtual int next_port(int from, int to) const = 0;
  /// Links on the route; -1 if there is no way. Walks it, unless the kind knows better.
  virtual int distance(int from, int to) const;
  /// Over all routes to one processor.
  virtual RouteSum sum_to(int to) const;
  /// Over all routes.
  virtual RouteSum sum() const;
  /// Adds all turns on routes to the processors `first` to `last` - 1, and perhaps other turns that
  /// there are.
  virtual void add_turns(Turns& turns, int first, int last) const;

  int processors() const { return static_cast<int>(peers_.size()); }
  const Peers& peers() const { return peers_; }

 private:
  Peers peers_;
};

}  // namespace topologies

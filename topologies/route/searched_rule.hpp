#pragma once
// Shortest routes of arbitrary topologies, found when needed.

#include <array>
#include <memory>
#include <mutex>

#include "topologies/route/rule.hpp"

namespace topologies {

/// A route takes the lowest port to a neighbour that is one link nearer to the destination. A
/// bit-parallel search finds the routes to 64 destinations at a time. A cache keeps them in two
/// bits per pair. In a machine of 65536 processors, 64 destinations take 1 MB and some
/// milliseconds.
class SearchedRule : public Rule {
 public:
  /// The topology may have lost links since it passed `check`.
  explicit SearchedRule(const Topology& topology);

  int next_port(int from, int to) const override;
  RouteSum sum() const override;
  void add_turns(Turns& turns, int first, int last) const override;

 private:
  static constexpr int GROUP = 64;  // destinations per search, one bit of a word each
  using Word = std::uint64_t;
  struct Routes {
    // For each processor, its ports to the group's destinations: a word of their low bits and a
    // word of their high bits, with one bit per destination.
    std::vector<std::array<Word, 2>> port;
    RouteSum sum;
  };
  struct Work;

  Routes find_routes(int group) const;
  static void add_step(const Peers& peers, Work& work, Routes& routes);
  int groups() const { return (processors() + GROUP - 1) / GROUP; }
  // Destinations of the group that `from` can reach, except itself.
  Word ends_reached(int from, int group) const;

  std::vector<int> piece_;                                    // connected component, by processor
  bool is_whole_ = false;                                     // true if the topology is connected
  mutable std::vector<std::unique_ptr<const Routes>> found_;  // by group of destinations
  mutable std::vector<std::once_flag> finds_;                 // by group of destinations
};

}  // namespace topologies

#pragma once
// Shortest routes of any topology, found as they are asked for.

#include <array>
#include <memory>
#include <mutex>

#include "topologies/route/rule.hpp"

namespace topologies {

/// Of the neighbours that are one link nearer the one on the lowest port is taken. Routes to 64
/// processors are found at a time, by searches of which each has a bit of a word, and kept: two
/// bits a pair, 1 MB for 64 ends among 65536 processors, found in some milliseconds.
class SearchedRule : public Rule {
 public:
  /// The topology may have lost links.
  explicit SearchedRule(const Topology& topology);

  int next_port(int from, int to) const override;
  RouteSum sum() const override;
  void add_turns(Turns& turns, int first, int last) const override;

 private:
  static constexpr int GROUP = 64;  // ends, a bit of a word for each
  using Word = std::uint64_t;
  struct Routes {
    std::vector<std::array<Word, 2>> port;  // by processor: the bits of its port to each end
    RouteSum sum;
  };
  struct Work;

  Routes find_routes(int group) const;
  static void add_step(const Peers& peers, Work& work, Routes& routes);
  int groups() const { return (processors() + GROUP - 1) / GROUP; }
  Word ends_reached(int from, int group) const;  // other ends

  std::vector<int> piece_;                                    // of connected processors
  bool is_whole_ = false;                                     // one piece
  mutable std::vector<std::unique_ptr<const Routes>> found_;  // by group
  mutable std::vector<std::once_flag> finds_;                 // the same
};

}  // namespace topologies

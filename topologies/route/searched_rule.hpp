#pragma once
// Shortest routes of any topology, found on demand.

#include <array>
#include <memory>
#include <mutex>

#include "topologies/route/rule.hpp"

namespace topologies {

/// Takes the lowest port to a neighbour that is one link nearer. Finds routes to 64 processors at a
/// time, by searches with one bit of a word each, and keeps them in two bits a pair. For 64 ends
/// among 65536 processors that takes 1 MB and some milliseconds.
class SearchedRule : public Rule {
 public:
  /// The topology may have lost links.
  explicit SearchedRule(const Topology& topology);

  int next_port(int from, int to) const override;
  RouteSum sum() const override;
  void add_turns(Turns& turns, int first, int last) const override;

 private:
  static constexpr int GROUP = 64;  // ends with one bit of a word each
  using Word = std::uint64_t;
  struct Routes {
    std::vector<std::array<Word, 2>> port;  // by processor: the bits of its port to each end
    RouteSum sum;
  };
  struct Work;

  Routes find_routes(int group) const;
  static void add_step(const Peers& peers, Work& work, Routes& routes);
  int groups() const { return (processors() + GROUP - 1) / GROUP; }
  Word ends_reached(int from, int group) const;  // reachable ends other than `from`

  std::vector<int> piece_;                                    // connected component, by processor
  bool is_whole_ = false;                                     // connected
  mutable std::vector<std::unique_ptr<const Routes>> found_;  // by group
  mutable std::vector<std::once_flag> finds_;                 // by group
};

}  // namespace topologies

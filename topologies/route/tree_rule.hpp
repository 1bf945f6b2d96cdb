#pragma once
// The only routes of a topology without cycles, found by the places of processors in it.

#include "topologies/route/rule.hpp"

namespace topologies {

/// A processor knows the interval of numbers below each of its links, in the order in which a walk
/// from the root comes by; what is in none of them is above.
class TreeRule : public Rule {
 public:
  /// The topology is connected and has no cycles.
  explicit TreeRule(const Topology& topology);

  int next_port(int from, int to) const override;
  int distance(int from, int to) const override;
  RouteSum sum() const override;
  void add_turns(Turns& turns, int first, int last) const override;

 private:
  bool is_below(int p, int top) const {  // or the same
    return begin_[p] >= begin_[top] && begin_[p] < begin_[top] + size_[top];
  }

  std::vector<int> parent_, depth_;
  std::vector<int> begin_, size_;  // of the interval at a processor and below
};

}  // namespace topologies

#pragma once
// Routes of a tree, by interval routing.

#include "topologies/route/rule.hpp"

namespace topologies {

/// Numbers processors in preorder from the root. The processors below a link are an interval of
/// these numbers; all other destinations are upwards.
class TreeRule : public Rule {
 public:
  /// The topology is connected and has no cycles.
  explicit TreeRule(const Topology& topology);

  int next_port(int from, int to) const override;
  int distance(int from, int to) const override;
  RouteSum sum() const override;
  void add_turns(Turns& turns, int first, int last) const override;

 private:
  bool is_below(int p, int top) const {  // or equal
    return begin_[p] >= begin_[top] && begin_[p] < begin_[top] + size_[top];
  }

  std::vector<int> parent_, depth_;
  std::vector<int> begin_, size_;  // interval of a processor's subtree
};

}  // namespace topologies

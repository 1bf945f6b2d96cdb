#pragma once
// Routes in a tree, by interval routing.

#include "topologies/route/rule.hpp"

namespace topologies {

/// Interval routing. Processors are numbered in preorder from the root, so that every subtree has
/// consecutive numbers. A destination below a child is reached through this child, any other
/// destination through the parent.
class TreeRule : public Rule {
 public:
  /// The topology must be connected and have no cycles.
  explicit TreeRule(const Topology& topology);

  int next_port(int from, int to) const override;
  int distance(int from, int to) const override;
  RouteSum sum() const override;
  void add_turns(Turns& turns, int first, int last) const override;

 private:
  bool is_below(int p, int top) const {  // true also if p == top
    return begin_[p] >= begin_[top] && begin_[p] < begin_[top] + size_[top];
  }

  std::vector<int> parent_, depth_;
  // Lowest number in each processor's subtree, and size of the subtree.
  std::vector<int> begin_, size_;
};

}  // namespace topologies

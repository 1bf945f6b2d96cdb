#pragma once
// The routers: each method in a file of its name. The node outlives the processes.
#include "simulator/network/node.hpp"

namespace network {

// Starts the processes of one processor's router. All are servers at high priority.
void start_naive(Node& node);
void start_chalmers(Node& node);
void start_green(Node& node);
void start_acyclic(Node& node);

// A process "processor.NAME" of a router.
template <class Body>
void start_server(Node& node, const std::string& name, Body body) {
  node.processor
      ->start(fmt::format("{}.{}", node.processor->name(), name), machine::Priority::high,
              std::move(body))
      .set_server();
}

// A plain ALT over ways in, which takes turns; returns the way, to be taken from.
class FairInputs {
 public:
  explicit FairInputs(const Node& node) : node_(node), ways_(node.ways()) {}
  std::size_t count() const { return ways_.size(); }
  // Guard number i of this turn, and its way.
  int way(std::size_t i) const { return ways_[(favourite_ + i) % ways_.size()]; }
  Guard guard(std::size_t i) const { return Guard(&node_.channel_in(way(i))); }
  void next_turn() { favourite_ = (favourite_ + 1) % ways_.size(); }
  int wait();

 private:
  const Node& node_;
  std::vector<int> ways_;
  std::size_t favourite_ = 0;
};

}  // namespace network

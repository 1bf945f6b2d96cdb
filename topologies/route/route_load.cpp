#include "topologies/route/route_load.hpp"

namespace topologies {
namespace {

// Counts messages on the links of given routes. The routes to one destination form a tree with the
// destination as its root.
class Collecting {
 public:
  explicit Collecting(const RoutingTable& routes)
      : routes_(routes),
        port_(routes.processors),
        before_(routes.processors),
        messages_(routes.processors),
        sent_(static_cast<std::size_t>(routes.processors) * PORTS) {}

  // Sends a message from each processor to `to`. A processor forwards messages only after all its
  // predecessors in the tree have sent theirs.
  void add_messages_to(int to) {
    const auto& peers = routes_.rule->peers();
    const auto next = [&](int p) { return peers[p][port_[p]]; };
    std::ranges::fill(before_, 0);
    std::ranges::fill(messages_, 1);
    for (int p = 0; p < routes_.processors; ++p)
      if (port_[p] = routes_.next_port(p, to); port_[p] >= 0) ++before_[next(p)];
    for (int p = 0; p < routes_.processors; ++p)
      for (int at = p; before_[at] == 0 && port_[at] >= 0; at = next(at)) {
        sent_[static_cast<std::size_t>(at) * PORTS + port_[at]] += messages_[at];
        messages_[next(at)] += messages_[at];
        before_[at] = DONE;
        --before_[next(at)];
      }
  }

  const Sent& sent() const { return sent_; }

 private:
  static constexpr int DONE = -1;

  const RoutingTable& routes_;
  std::vector<int> port_, before_;  // `before_`: number of predecessors that have not yet sent
  std::vector<std::int64_t> messages_;
  Sent sent_;
};

}  // namespace

Load eval_load(const Topology& topology, const RoutingTable& routes) {
  Collecting all(routes);
  for (int to = 0; to < topology.processors; ++to) all.add_messages_to(to);
  return make_load(topology, all.sent());
}

}  // namespace topologies

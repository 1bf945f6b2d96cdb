#pragma once
// The routers' tables of routes and trees. Clients never see them.
#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "topologies/route/routes.hpp"
#include "topologies/route/up_down.hpp"

namespace network {

using topologies::TreeLinks;

class Routing {
 public:
  /// Kind of the routes and trees made after a link is cut.
  enum class Kind { shortest, up_down };

  /// GLOBAL messages of all senders follow `tree`. Without it they follow a breadth-first tree of
  /// each sender.
  Routing(const topologies::Topology& topology, topologies::RoutingTable routes,
          std::optional<TreeLinks> tree = std::nullopt, Kind kind = Kind::shortest);

  int processors() const { return routes_.processors; }
  const topologies::Topology& topology() const { return epochs_.back().topology; }
  /// Port of processor `at` on the way to `to`, the lowest of several to the same neighbour. -1 if
  /// `at` is `to`, or if no way is left.
  int port_to(int at, int to) const { return routes_.next_port(at, to); }
  int distance(int from, int to) const { return routes_.distance(from, to); }
  Kind kind() const { return kind_; }
  /// Mean number of links, over all connected pairs.
  double mean_distance() const { return routes_.mean_distance(); }
  /// Number of cuts so far. A GLOBAL message keeps to the tree of its epoch, so that no processor
  /// gets it twice.
  std::size_t epoch() const { return epochs_.size() - 1; }
  /// Ports of `at` to its children in the tree of `sender`'s GLOBAL messages, ascending.
  const std::vector<int>& tree_ports(std::size_t epoch, int sender, int at) const;
  /// Processors in the subtree below `at`, itself first.
  std::vector<int> below(std::size_t epoch, int sender, int at) const;
  /// Processor across the link on a port, cut or not; -1 if there was no link.
  int neighbour(int at, int port) const { return peers_[at][port] == at ? -1 : peers_[at][port]; }

  /// Next port to the same neighbour, in rotation; `port` itself if there is no other.
  int beside(int at, int port) const { return parallel_[at][port]; }
  /// Number of links to that neighbour.
  int links_beside(int at, int port) const {
    return static_cast<int>(std::ranges::count(peers_[at], peers_[at][port]));
  }

  /// Recomputes routes and trees after a cut of all links between the two.
  void cut(int a, int b);

 private:
  using Ports = std::vector<std::uint8_t>;  // by processor, a bit for each port
  struct Trees {
    std::mutex lock;
    std::map<int, Ports> by_sender;  // built on demand
  };
  struct Epoch {
    topologies::Topology topology;  // with the remaining links
    std::optional<TreeLinks> tree;
    topologies::Topology allowed = {};  // with the tree's links only, or all without a tree
    std::shared_ptr<Trees> trees = std::make_shared<Trees>();
  };
  void add_epoch(topologies::Topology topology, std::optional<TreeLinks> tree);
  Ports make_tree(const Epoch& epoch, int sender) const;

  std::vector<Epoch> epochs_;
  topologies::RoutingTable routes_;
  Kind kind_;
  topologies::Peers peers_;
  std::vector<std::array<std::int8_t, topologies::PORTS>> parallel_;
};

/// Routes without a cycle of waiting links, and the root's tree for GLOBAL messages: `routes` if
/// they close no cycle together with the tree, else up*/down* routes.
Routing make_acyclic_routing(const topologies::Topology& topology,
                             const topologies::RoutingTable& routes);

}  // namespace network

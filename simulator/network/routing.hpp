#pragma once
// The routes and broadcast trees that routers use. Clients of the routers never see them.
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
  /// The kind of routes and trees that are made when a link has been cut.
  enum class Kind { shortest, up_down };

  /// `tree` is the tree for broadcast (GLOBAL) messages of all senders. If absent, each sender has
  /// a breadth-first tree of its own.
  Routing(const topologies::Topology& topology, topologies::RoutingTable routes,
          std::optional<TreeLinks> tree = std::nullopt, Kind kind = Kind::shortest);

  int processors() const { return routes_.processors; }
  const topologies::Topology& topology() const { return epochs_.back().topology; }
  /// The port of processor `at` on the route to `to`. If several links lead to that neighbour,
  /// their lowest port. Returns -1 if `at` is `to` or if no route is left.
  int port_to(int at, int to) const { return routes_.next_port(at, to); }
  const topologies::RoutingTable& routes() const { return routes_; }
  int distance(int from, int to) const { return routes_.distance(from, to); }
  Kind kind() const { return kind_; }
  /// Mean number of links on a route, over all pairs of processors that are connected.
  double mean_distance() const { return routes_.mean_distance(); }
  /// Number of cuts of links so far. A broadcast (GLOBAL) message keeps using the tree of its epoch
  /// (the time between two cuts when it was sent), so that no processor receives it twice.
  std::size_t epoch() const { return epochs_.size() - 1; }
  /// Ports of processor `at` that lead to its children in the tree of `sender`, in ascending order.
  const std::vector<int>& tree_ports(std::size_t epoch, int sender, int at) const;
  /// The processors in the subtree of `at` within the tree of `sender`. The first one is `at`.
  std::vector<int> below(std::size_t epoch, int sender, int at) const;
  /// The processor at the other end of the link at a port, even if the link has been cut; -1 if the
  /// port never had a link.
  int neighbour(int at, int port) const { return peers_[at][port] == at ? -1 : peers_[at][port]; }

  /// The next port to the same neighbour, in rotation. Returns `port` if there is no other one.
  int beside(int at, int port) const { return parallel_[at][port]; }
  /// Number of links from `at` to the neighbour that `port` leads to.
  int links_beside(int at, int port) const {
    return static_cast<int>(std::ranges::count(peers_[at], peers_[at][port]));
  }

  /// Computes new routes and trees after all links between `a` and `b` have been cut.
  void cut(int a, int b);

 private:
  using Ports = std::vector<std::uint8_t>;  // by processor: one bit for each port
  struct Trees {
    std::mutex lock;
    std::map<int, Ports> by_sender;  // trees by sender; each is made when first needed
  };
  struct Epoch {
    topologies::Topology topology;  // the topology without links that were cut
    std::optional<TreeLinks> tree;
    // The topology with only the links of the tree, or with all links if there is no tree.
    topologies::Topology allowed = {};
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

/// Makes routes that cannot deadlock, and a tree from the root for all broadcast (GLOBAL) messages.
/// Keeps `routes` if messages on these routes and on the tree cannot make links wait for each other
/// in a cycle. Otherwise makes up*/down* routes: a message that has gone down never goes up again.
Routing make_acyclic_routing(const topologies::Topology& topology,
                             const topologies::RoutingTable& routes);

}  // namespace network

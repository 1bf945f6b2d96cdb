#pragma once
// Which way a message goes: the routers' tables. Clients never see them.
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
  /// The routes and trees that are made after a link is cut.
  enum class Kind { shortest, up_down };

  /// GLOBAL messages go along `tree`, the same for all senders; without one along a breadth-first
  /// tree of each sender.
  Routing(const topologies::Topology& topology, topologies::RoutingTable routes,
          std::optional<TreeLinks> tree = std::nullopt, Kind kind = Kind::shortest);

  int processors() const { return routes_.processors; }
  const topologies::Topology& topology() const { return epochs_.back().topology; }
  /// The port of processor `at` on the way to `to`, the lowest of several to the same neighbour; -1
  /// if they are the same or no way is left.
  int port_to(int at, int to) const { return routes_.next_port(at, to); }
  int distance(int from, int to) const { return routes_.distance(from, to); }
  Kind kind() const { return kind_; }
  /// Links, over all pairs that have a way.
  double mean_distance() const { return routes_.mean_distance(); }
  /// Number of links cut so far. A GLOBAL message keeps to the tree of its epoch, so that no
  /// processor gets it twice.
  std::size_t epoch() const { return epochs_.size() - 1; }
  /// The ports by which `at` passes a GLOBAL message of `sender` on, ascending.
  const std::vector<int>& tree_ports(std::size_t epoch, int sender, int at) const;
  /// The processors that get such a message through `at`, itself first.
  std::vector<int> below(std::size_t epoch, int sender, int at) const;
  /// The processor across the link on a port, cut or not; -1 if there was no link.
  int neighbour(int at, int port) const { return peers_[at][port] == at ? -1 : peers_[at][port]; }

  /// The next port that leads to the same neighbour; `port` itself if there is no other.
  int beside(int at, int port) const { return parallel_[at][port]; }
  /// How many links lead to that neighbour.
  int links_beside(int at, int port) const {
    return static_cast<int>(std::ranges::count(peers_[at], peers_[at][port]));
  }

  /// All links between the two are cut: from now on routes and trees are those of what is left.
  void cut(int a, int b);

 private:
  using Ports = std::vector<std::uint8_t>;  // by processor, a bit for each port
  struct Trees {
    std::mutex lock;
    std::map<int, Ports> by_sender;  // as they are asked for
  };
  struct Epoch {
    topologies::Topology topology;  // with the links that are left
    std::optional<TreeLinks> tree;
    topologies::Topology allowed = {};  // with the tree's links, or all if there is none
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

/// Routes that close no cycle of waiting links, and the tree for GLOBAL messages that goes with
/// them: `routes` and the root's tree if they close none, else up*/down*.
Routing make_acyclic_routing(const topologies::Topology& topology,
                             const topologies::RoutingTable& routes);

}  // namespace network

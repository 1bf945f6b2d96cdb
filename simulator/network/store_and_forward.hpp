#pragma once
// Store-and-forward routing of packets between all processors, on shortest or given routes. A
// processor may also send packets to itself.
//
//               links             the processor                        links
//             ---------> receiver ---.            .--> sender ------------>
//             ---------> receiver ----+-> queue --'    (of each link
//   client -- into ----> entry -------'                 and of the client) --> delivered -- client
//
// Each incoming link has a receiver process, so that no link waits for another link. Each way out
// has an unbounded queue, so that no receiver waits for a link. A sender signals its queue when it
// is free. All processes have high priority and pass pointers to packets. Deadlock is impossible,
// because every receiver always returns to its link. longest_queue() tells how much memory would be
// needed.
#include <deque>
#include <vector>

#include "simulator/occam/channel.hpp"
#include "topologies/route/routes.hpp"

namespace network {

using occam::Channel;
using occam::Proc;
using occam::Signal;

struct Packet {
  int from = 0, to = 0;      ///< numbers of processors in the topology
  std::uint64_t length = 0;  ///< length on a link in bytes
  std::uint64_t id = 0;      ///< at the sender's disposal
  std::uint64_t bytes() const { return length; }
};

/// A pointer to a packet, for passing the packet within a processor.
struct Pointer {
  Packet to;
  static constexpr std::uint64_t bytes() { return 4; }
};

class StoreAndForward {
 public:
  /// Links the machine's processors `first`, `first` + 1, ... as the topology says, and starts the
  /// routers. The topology must be valid (topologies::check).
  StoreAndForward(machine::Machine& machine, const topologies::Topology& topology, int first = 0)
      : StoreAndForward(machine, topology, make_routes(topology), first) {}
  /// Like the first constructor, but with the given routes, which must join all pairs of
  /// processors.
  StoreAndForward(machine::Machine& machine, const topologies::Topology& topology,
                  topologies::RoutingTable routes, int first = 0);

  Channel<Pointer>& into(int processor) { return into_.at(processor); }
  Channel<Pointer>& delivered(int processor) { return delivered_.at(processor); }
  const topologies::RoutingTable& routes() const { return routes_; }
  std::size_t longest_queue() const;  ///< maximum number of packets in any queue so far
  /// Total number of guards in the ALTs of all queues on the route between two processors. The cost
  /// of an ALT grows with the number of its guards.
  int guards_on_the_way(int from, int to);

 private:
  static constexpr int CLIENT = topologies::PORTS;  // the way to the client of the processor itself
  static constexpr int WAYS = CLIENT + 1;
  template <class Item>
  using ByWay = std::array<Item, WAYS>;

  struct Node {
    machine::Processor* processor;
    // Channels into the queue of each way out, one from each way in; the way in CLIENT is the
    // entry. A channel is null if both ways are the same link, because a packet never turns back.
    // Packets from the client may return to the client.
    ByWay<ByWay<Channel<Pointer>*>> queue_in{};
    ByWay<Channel<Signal>*> sent{};
    ByWay<Channel<Pointer>*> to_sender{};
    // For each neighbour, at the lowest port that leads to it: the port that the next packet takes.
    std::array<std::int8_t, topologies::PORTS> turn{0, 1, 2, 3};
    std::uint32_t longest_queue = 0;
  };
  void start(int id, const char* what, int way, Proc body);
  void start_way_out(int id, int way, Channel<Packet>* link);
  void start_way_in(int id, int way, Channel<Packet>* link);
  int take_way_to(int from, int to);
  int guards_of(int id, int way) const;
  Proc receive(int id, int way, Channel<Packet>* link);

  topologies::Topology topology_;
  topologies::RoutingTable routes_;
  std::vector<std::array<std::int8_t, topologies::PORTS>> parallel_;
  std::deque<Channel<Pointer>> into_, delivered_, pointers_;
  std::deque<Channel<Signal>> signals_;
  std::deque<Channel<Packet>> links_;
  std::vector<Node> nodes_;
};

}  // namespace network

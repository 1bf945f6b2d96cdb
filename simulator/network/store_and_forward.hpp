#pragma once
// Store-and-forward routing of packets on shortest routes between all processors. A processor may
// also send to itself.
//
//               links             the processor                        links
//             ---------> receiver ---.            .--> sender ------------>
//             ---------> receiver ----+-> queue --'    (of each link
//   client -- into ----> entry -------'                 and of the client) --> delivered -- client
//
// Each incoming link has a receiver, so that no link waits for another. Each way out has an
// unbounded queue, so that no receiver waits for a link. When a sender is free, it signals its
// queue. All processes have high priority and pass pointers. Deadlock is impossible, because every
// receiver always returns to its link. The memory needed follows from longest_queue().
#include <deque>
#include <vector>

#include "simulator/occam/channel.hpp"
#include "topologies/route/routes.hpp"

namespace network {

using occam::Channel;
using occam::Proc;
using occam::Signal;

struct Packet {
  int from = 0, to = 0;      ///< numbers in the topology
  std::uint64_t length = 0;  ///< in bytes on a link
  std::uint64_t id = 0;      ///< available to the sender
  std::uint64_t bytes() const { return length; }
};

/// A pointer to a packet, as a message within a processor.
struct Pointer {
  Packet to;
  static constexpr std::uint64_t bytes() { return 4; }
};

class StoreAndForward {
 public:
  /// Links the machine's processors `first`, `first` + 1, ... by the topology and starts the
  /// routers. The topology must pass topologies::check.
  StoreAndForward(machine::Machine& machine, const topologies::Topology& topology, int first = 0);

  Channel<Pointer>& into(int processor) { return into_.at(processor); }
  Channel<Pointer>& delivered(int processor) { return delivered_.at(processor); }
  const topologies::RoutingTable& routes() const { return routes_; }
  std::size_t longest_queue() const;  ///< maximum up to now, in packets
  /// Total number of guards in the ALTs of the queues between two processors. The cost of an ALT
  /// grows with the number of its guards.
  int guards_on_the_way(int from, int to);

 private:
  static constexpr int CLIENT = topologies::PORTS;  // way to the processor's own client
  static constexpr int WAYS = CLIENT + 1;
  template <class Item>
  using ByWay = std::array<Item, WAYS>;

  struct Node {
    machine::Processor* processor;
    // Channels into the queue of each way out, by the receiver's port, or by CLIENT for the entry.
    // Null if both are the same link, because a packet does not turn back. Packets from the client
    // may return to the client.
    ByWay<ByWay<Channel<Pointer>*>> queue_in{};
    ByWay<Channel<Signal>*> sent{};
    ByWay<Channel<Pointer>*> to_sender{};
    // The port for the next packet to a neighbour, indexed by the lowest port to it.
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

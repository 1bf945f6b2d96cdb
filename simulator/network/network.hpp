#pragma once
// Message passing between arbitrary processes on any topology. Each processor has a router.
// Processes are clients of their router and know only addresses (thesis, 5.1.1). The manual's page
// docs/manual/deadlock.md explains the methods that avoid deadlock.
#include <deque>
#include <memory>

#include "simulator/network/node.hpp"

namespace network {

enum class Method : std::uint8_t {
  naive,  ///< passes each message on before it takes the next; may deadlock
  /// Sends one message at a time and meanwhile buffers arriving ones (thesis, figure 5.11).
  chalmers,
  /// Sender processes only for clients and lower-numbered neighbours (thesis, figures 5.12 to
  /// 5.14).
  green,
  /// Routes that let no links wait for each other in a cycle (see make_acyclic_routing).
  acyclic,
};

struct Params {
  Method method = Method::green;
  /// Within a processor, passes a pointer to a message instead of copying the message.
  bool pointers = true;
  /// Number of messages that a router's queues can hold in total, at least 1. In addition, each
  /// process of the router holds one message.
  std::size_t buffers = 64;
  std::uint64_t longest = 512;  ///< maximum length in bytes of a message's contents
  /// For each processor and each of its clients (at most MAX_CLIENTS), the set of process numbers
  /// that the client receives messages for, one bit for each. If empty, each processor has one
  /// client for all.
  std::vector<std::vector<std::uint32_t>> processes;
  /// For each processor: its companion (a second processor on the same memory), which runs clients
  /// number 1 and higher, or null if all clients run on the processor itself. If empty, null for
  /// all processors.
  std::vector<const machine::Processor*> companions = {};
};

/// The two channels between a process and its router. Only one process may use a client.
class Client {
 public:
  /// `longest` is the maximum length in bytes of a message's contents. `own` is the processor of
  /// the client's process: either `router` or its companion.
  Client(int processor, const std::string& name, bool pointers, std::uint64_t longest,
         const machine::Processor& own, const machine::Processor& router)
      : processor_(processor),
        pointers_(pointers),
        longest_(longest),
        into_(name + ".into", own, router, occam::Protocol::counted),
        from_(name + ".from", router, own, occam::Protocol::counted) {}

  int processor() const { return processor_; }
  /// Sends a message: `into.router ! message`. Sets `from.processor`. Throws base::InvariantBroken
  /// if the contents are longer than Params::longest.
  void send(Message message);
  /// Returns a message that was offered to this client (Mode::in_path_to) to the router, unchanged.
  void give_back(Message message);
  /// Receives a message: `from.router ? message`.
  Message receive() { return from_.in().message; }
  /// The channel from the router, for use as a guard of an ALT.
  Channel<Handed>& from_router() { return from_; }

 private:
  friend class Network;
  int processor_;
  bool pointers_;
  std::uint64_t longest_;
  Channel<Handed> into_, from_;
};

class Network {
 public:
  /// Links the machine's processors `first`, `first` + 1, ... as the routing's topology says, and
  /// starts a router on each. The method `acyclic` needs routes made by make_routing for this
  /// method. Throws base::BadInput if buffers and messages exceed the memory of a processor.
  Network(machine::Machine& machine, Routing routing, const Params& params, int first = 0);

  Client& client(int processor, int number = 0) { return *clients_.at(processor).at(number); }
  const Routing& routing() const { return routing_; }
  const RouterUse& use(int processor) const { return nodes_.at(processor).use; }
  RouterUse use() const;  ///< sum over all routers
  /// Number of messages that are now in the queues of the processor's router.
  std::size_t held(int processor) const { return nodes_.at(processor).held; }

 private:
  void make_node(int id, machine::Processor& processor, const Params& params);

  Routing routing_;
  std::deque<Node> nodes_;
  std::deque<Channel<Message>> links_;
  std::vector<std::vector<std::unique_ptr<Client>>> clients_;
};

/// Makes the routes and broadcast trees that a method needs.
Routing make_routing(Method method, const topologies::Topology& topology,
                     const topologies::RoutingTable& routes,
                     const std::optional<TreeLinks>& tree = std::nullopt);

}  // namespace network

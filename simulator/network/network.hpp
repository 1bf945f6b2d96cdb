#pragma once
// Message passing between arbitrary processes on any topology. Each processor has a router and
// clients, which know only addresses (5.1.1). For the methods of avoiding deadlock see
// docs/manual/deadlock.md.
#include <deque>
#include <memory>

#include "simulator/network/node.hpp"

namespace network {

enum class Method : std::uint8_t {
  naive,     ///< passes each message on before taking the next; may deadlock
  chalmers,  ///< sends one message at a time and buffers arrivals meanwhile (figure 5.11)
  green,     ///< has senders for lower-numbered processors and clients only (figures 5.12 to 5.14)
  acyclic,   ///< uses routes on which links cannot wait for each other in a cycle (see Routing)
};

struct Params {
  Method method = Method::green;
  bool pointers = true;  ///< within a processor, pass a pointer instead of copying the message
  /// Total capacity of a router's queues in messages, at least 1. In addition, each process of the
  /// router holds one message.
  std::size_t buffers = 64;
  std::uint64_t longest = 512;  ///< maximum length of a message's contents in bytes
  /// The processes served by each client, by processor and client (at most MAX_CLIENTS), as bit
  /// sets. Empty: each processor has one client for all processes.
  std::vector<std::vector<std::uint32_t>> processes;
  /// By processor: its companion, if clients from number 1 on run there; null if all run on the
  /// processor itself. Empty: null for all processors.
  std::vector<const machine::Processor*> companions = {};
};

/// The channels between a process and its router. A client must be used by one process only.
class Client {
 public:
  /// `longest` is the maximum length of contents in bytes. `own` is the processor of the client's
  /// process, either `router` or its companion.
  Client(int processor, const std::string& name, bool pointers, std::uint64_t longest,
         const machine::Processor& own, const machine::Processor& router)
      : processor_(processor),
        pointers_(pointers),
        longest_(longest),
        into_(name + ".into", own, router, occam::Protocol::counted),
        from_(name + ".from", router, own, occam::Protocol::counted) {}

  int processor() const { return processor_; }
  /// `into.router ! message`. Sets `from.processor`. Throws base::InvariantBroken if the message is
  /// longer than Params::longest.
  void send(Message message);
  /// Returns a message offered to this client (Mode::in_path_to) to the router, unchanged.
  void give_back(Message message);
  /// `from.router ? message`
  Message receive() { return from_.in().message; }
  /// The channel from the router, for use in an ALT.
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
  /// Links the machine's processors `first`, `first` + 1, ... by the routing's topology and starts
  /// a router on each. The method `acyclic` needs deadlock-free routes, see make_routing. Throws
  /// base::BadInput if buffers and messages exceed the processors' memory.
  Network(machine::Machine& machine, Routing routing, const Params& params, int first = 0);

  Client& client(int processor, int number = 0) { return *clients_.at(processor).at(number); }
  const Routing& routing() const { return routing_; }
  const RouterUse& use(int processor) const { return nodes_.at(processor).use; }
  RouterUse use() const;  ///< sum over all routers
  /// Number of messages now in the queues of the processor's router.
  std::size_t held(int processor) const { return nodes_.at(processor).held; }

 private:
  void make_node(int id, machine::Processor& processor, const Params& params);

  Routing routing_;
  std::deque<Node> nodes_;
  std::deque<Channel<Message>> links_;
  std::vector<std::vector<std::unique_ptr<Client>>> clients_;
};

/// Makes the routes and trees that a method needs.
Routing make_routing(Method method, const topologies::Topology& topology,
                     const topologies::RoutingTable& routes,
                     const std::optional<TreeLinks>& tree = std::nullopt);

}  // namespace network

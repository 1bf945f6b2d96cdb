#pragma once
// Messages between any processes, over any topology. Each processor has a router and clients;
// clients know only addresses (5.1.1). Methods against deadlock: see docs/manual/deadlock.md.
#include <deque>
#include <memory>

#include "simulator/network/node.hpp"

namespace network {

enum class Method : std::uint8_t {
  naive,     ///< takes a message, passes it on, takes the next: shows the deadlock
  chalmers,  ///< passes one message at a time and memorises arrivals meanwhile (figure 5.11)
  green,     ///< has senders to processors of lower numbers, and to clients (figures 5.12 to 5.14)
  acyclic,   ///< links wait for each other, but never in a cycle (see Routing)
};

struct Params {
  Method method = Method::green;
  bool pointers = true;  ///< within a processor, pass a pointer instead of the message
  /// Capacity of a router's queues in messages, at least 1. Each router process that passes
  /// messages has room for one more.
  std::size_t buffers = 64;
  std::uint64_t longest = 512;  ///< bytes of the longest message's contents: size of a buffer
  /// Processes of each client of each processor (at most MAX_CLIENTS), one bit each. Empty: one
  /// client per processor, for every process.
  std::vector<std::vector<std::uint32_t>> processes;
  /// Each processor's companion if its clients from number 1 on run there, else null. Empty: all
  /// clients are on the processor itself.
  std::vector<const machine::Processor*> companions = {};
};

/// The channels of a process to and from its router. Only one process uses a client.
class Client {
 public:
  /// `longest`: size of a buffer, in bytes of contents. `own`: processor of the client's process,
  /// either `router` or its companion.
  Client(int processor, const std::string& name, bool pointers, std::uint64_t longest,
         const machine::Processor& own, const machine::Processor& router)
      : processor_(processor),
        pointers_(pointers),
        longest_(longest),
        into_(name + ".into", own, router, occam::Protocol::counted),
        from_(name + ".from", router, own, occam::Protocol::counted) {}

  int processor() const { return processor_; }
  /// `into.router ! message`. Fills in `from.processor`. Throws base::InvariantBroken for a message
  /// longer than Params::longest.
  void send(Message message);
  /// Returns an offered message (InPathTo) to the router unchanged.
  void give_back(Message message);
  /// `from.router ? message`
  Message receive() { return from_.in().message; }
  /// Input channel, for an ALT.
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
  /// Joins the machine's processors `first`, `first` + 1, ... by the routing's topology and starts
  /// a router on each. The method `acyclic` needs routes without a cycle: see make_routing. Throws
  /// base::BadInput if buffers and messages do not fit the processors' memory.
  Network(machine::Machine& machine, Routing routing, const Params& params, int first = 0);

  Client& client(int processor, int number = 0) { return *clients_.at(processor).at(number); }
  const Routing& routing() const { return routing_; }
  const RouterUse& use(int processor) const { return nodes_.at(processor).use; }
  RouterUse use() const;  ///< sum over all routers
  /// Messages in the queues of the processor's router now.
  std::size_t held(int processor) const { return nodes_.at(processor).held; }

 private:
  void make_node(int id, machine::Processor& processor, const Params& params);

  Routing routing_;
  std::deque<Node> nodes_;
  std::deque<Channel<Message>> links_;
  std::vector<std::vector<std::unique_ptr<Client>>> clients_;
};

/// Makes the routing for a method.
Routing make_routing(Method method, const topologies::Topology& topology,
                     const topologies::RoutingTable& routes,
                     const std::optional<TreeLinks>& tree = std::nullopt);

}  // namespace network

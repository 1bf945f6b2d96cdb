#pragma once
// Any process to any other, over any topology: a router on every processor, and its clients, which
// know only addresses (5.1.1). How routers avoid deadlock is a method: see docs/manual/deadlock.md.
#include <deque>
#include <memory>

#include "simulator/network/node.hpp"

namespace network {

enum class Method : std::uint8_t {
  naive,     ///< takes a message, passes it on, takes the next: for the deadlock
  chalmers,  ///< passes one message at a time, and memorises all that come meanwhile (figure 5.11)
  green,     ///< has senders to processors of lower numbers, and to clients (figures 5.12 to 5.14)
  acyclic,   ///< every link waits for the next, and no chain of those closes (see Routing)
};

struct Params {
  Method method = Method::green;
  bool pointers = true;  ///< within a processor a pointer is passed, not the message
  /// Messages that a router has room for in its queues, at least 1. Each of its processes that
  /// passes messages has room for one more, beside these.
  std::size_t buffers = 64;
  std::uint64_t longest = 512;  ///< bytes of the longest message's contents: what a buffer takes
  /// For each processor and each of its clients, at most MAX_CLIENTS, the processes that the client
  /// is, one bit each. Empty: one client on each processor, which is every process.
  std::vector<std::vector<std::uint32_t>> processes;
  /// For each processor its companion, if its clients from number 1 on are processes there, or
  /// null. Empty: all are on the processor itself.
  std::vector<const machine::Processor*> companions = {};
};

/// The channels that a process of the machine has into its router and from it. One process uses a
/// client.
class Client {
 public:
  /// `longest`: bytes of contents that there are buffers for. `own` is where the client's process
  /// is: the router's processor or its companion.
  Client(int processor, const std::string& name, bool pointers, std::uint64_t longest,
         const machine::Processor& own, const machine::Processor& router)
      : processor_(processor),
        pointers_(pointers),
        longest_(longest),
        into_(name + ".into", own, router, occam::Protocol::counted),
        from_(name + ".from", router, own, occam::Protocol::counted) {}

  int processor() const { return processor_; }
  /// `into.router ! message`. `from.processor` is filled in. Throws base::InvariantBroken for a
  /// message longer than Params::longest.
  void send(Message message);
  /// Gives back to the router, unchanged, what it has offered (InPathTo).
  void give_back(Message message);
  /// `from.router ? message`
  Message receive() { return from_.in().message; }
  /// For ALT.
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
  /// Joins the machine's processors `first`, `first` + 1, ... as the routing's topology says, and
  /// starts a router on each. The method `acyclic` needs routes that close no cycle: see
  /// make_routing. Throws base::BadInput if buffers and messages do not fit the processors' memory.
  Network(machine::Machine& machine, Routing routing, const Params& params, int first = 0);

  Client& client(int processor, int number = 0) { return *clients_.at(processor).at(number); }
  const Routing& routing() const { return routing_; }
  const RouterUse& use(int processor) const { return nodes_.at(processor).use; }
  RouterUse use() const;  ///< the sum of all
  /// Messages that the processor's router holds now.
  std::size_t held(int processor) const { return nodes_.at(processor).held; }

 private:
  void make_node(int id, machine::Processor& processor, const Params& params);

  Routing routing_;
  std::deque<Node> nodes_;
  std::deque<Channel<Message>> links_;
  std::vector<std::vector<std::unique_ptr<Client>>> clients_;
};

/// The routing that a method needs.
Routing make_routing(Method method, const topologies::Topology& topology,
                     const topologies::RoutingTable& routes,
                     const std::optional<TreeLinks>& tree = std::nullopt);

}  // namespace network

#pragma once
// What a router has on its processor: ways in and out, the tables, and room for messages.
//
//   links 0 to 3 ---> |        | ---> links 0 to 3
//                     | router |
//   clients     ----> |        | ---> clients
#include <array>
#include <deque>
#include <set>

#include "simulator/machine/faults.hpp"
#include "simulator/network/message.hpp"
#include "simulator/network/routing.hpp"
#include "simulator/occam/alt.hpp"
#include "simulator/occam/channel.hpp"

namespace network {

using occam::Channel;
using occam::Guard;
using occam::Signal;

// A way: the port of a link, or CLIENT + n for the processor's client number n.
constexpr int CLIENT = topologies::PORTS;
constexpr int MAX_CLIENTS = 4;
constexpr int WAYS = CLIENT + MAX_CLIENTS;
constexpr int NO_WAY = -1;  // a message that this router has sent and could not

// A router had no room for a message.
struct Overflow : machine::Fault {
  using Fault::Fault;
};

struct RouterUse {
  std::uint64_t taken = 0;   // from clients
  std::uint64_t passed = 0;  // from one link to another ("EE" in table 5.1), counted as they come
  std::uint64_t delivered = 0;  // to clients; what has come back to its sender is not counted
  std::uint64_t returned = 0;   // to its sender, as it could not be delivered
  std::uint64_t lost = 0;       // could not be returned either
  std::size_t most_held = 0;    // messages at once
};

// The ways that a message takes from here.
struct WaysOut {
  std::array<std::int8_t, WAYS> way{};
  std::size_t count = 0;
  void add(int w) { way.at(count++) = static_cast<std::int8_t>(w); }
  const std::int8_t* begin() const { return way.data(); }
  const std::int8_t* end() const { return way.data() + count; }
};

struct Node {
  int id = 0;
  machine::Processor* processor = nullptr;
  const Routing* routing = nullptr;
  std::size_t buffers = 0;  // messages that there is room for in queues
  bool pointers = true;     // see Params
  occam::Cycles look_up{}, fifo_step{}, buffer_step{}, copy_setup{}, copy_word{};
  std::array<Channel<Message>*, topologies::PORTS> link_in{}, link_out{};
  std::vector<Channel<Handed>*> client_in, client_out;
  std::vector<std::uint32_t> processes;  // of each client, a bit for each process
  RouterUse use;
  std::size_t held = 0;

  std::vector<int> ways() const;  // in and out: the same
  occam::ChannelBase& channel_in(int way) const;

  // `channel ? message`; none if the link is cut.
  std::optional<Message> take(int way);
  // `channel ! message`; false if the link is cut.
  bool pass(int way, const Message& message);
  // determ.ways.out of figure 5.14: where the message that came by this way goes from here. A
  // message that cannot be delivered turns back to its sender; if that has no way, none is left.
  WaysOut find_ways_out(Message& message, int came_by);
  // A GLOBAL message of this processor that no tree takes everywhere: a message for each processor
  // that is left out, to be sent from here next (it will turn back).
  std::vector<Message> take_unreached() { return std::exchange(unreached_, {}); }
  // Of a message whose link was cut: what must be sent from here in its place.
  std::vector<Message> send_around(Message message, int way);

  // Room for one more message, which is copied unless pointers are used. Throws Overflow.
  void hold(const Message& message);
  void release(const Message& message);

 private:
  int client_of(int process) const;  // a way, or NO_WAY
  void turn_back(Message& message, Returned reason);
  void charge_step(const Message& message) const;
  void note_unreached(const Message& message);

  std::vector<Message> unreached_;
};

}  // namespace network

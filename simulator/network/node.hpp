#pragma once
// State of a processor's router: ways in and out, tables, and memory for messages. Routers pass
// messages between processes on any two processors (thesis, figure 5.5).
//
//   links 0 to 3 ---> |        | ---> links 0 to 3
//                     | router |
//   clients     ----> |        | ---> clients
#include <array>
#include <deque>

#include "simulator/network/routing.hpp"
#include "simulator/occam/alt.hpp"

namespace network {

using occam::Channel;
using occam::Signal;

/// Meaning of the processor in an address (thesis, 5.1.1.1 to 5.1.1.3).
enum class Mode : std::uint8_t {
  unicast,  ///< to one processor
  global,   ///< to the process with this number on all other processors; `processor` is ignored
  /// Offered to the process with this number on each processor of the route to `processor`.
  in_path_to,
};

constexpr int MAX_PROCESSES = 32;

/// A two-level address: a processor, and a process on it.
struct Address {
  int processor = 0;
  /// Number of the process, 0 to MAX_PROCESSES - 1. A processor has at most one process with each
  /// number.
  int process = 0;
  Mode mode = Mode::unicast;
  bool operator==(const Address&) const = default;
};
constexpr Address make_global(int process) { return {0, process, Mode::global}; }

/// Reason why a message was returned to its sender.
enum class Returned : std::uint8_t { no, no_processor, no_process, no_route };
std::string_view to_string(Returned reason);

/// Contents of a message. Routers cannot look inside.
struct Contents {
  virtual ~Contents() = default;
};
/// Contents of type T, which is usually a variant of all message types of a program.
template <class T>
struct ContentsOf final : Contents {
  explicit ContentsOf(T of) : content(std::move(of)) {}
  const T content;
};

struct Message {
  Address to = {}, from = {};
  std::uint64_t length = 0;  ///< length of `contents` in bytes
  std::uint64_t number = 0;  ///< ignored by routers; at the sender's disposal
  std::shared_ptr<const Contents> contents = {};
  Returned returned = Returned::no;
  int links = 0;  ///< number of links passed so far
  /// For broadcast (GLOBAL) messages: number of link cuts before the message was sent, see
  /// Routing::epoch().
  std::size_t tree = 0;

  /// Length in bytes of the part that identifies a message: address, sender and length, five words
  /// (thesis, speed column of table 5.3).
  static constexpr std::uint64_t IDENTIFICATION = 20;
  std::uint64_t bytes() const { return IDENTIFICATION + length; }
};

/// Makes a message. If it cannot be delivered, it returns to process number `process` of the
/// sending processor.
template <class T>
Message make_message(int process, const Address& to, std::uint64_t length, T content) {
  return {.to = to,
          .from = {.process = process},
          .length = length,
          .contents = std::make_shared<const ContentsOf<T>>(std::move(content))};
}
/// Returns the contents of a message. Throws std::bad_cast if they do not have type T.
template <class T>
const T& read(const Message& message) {
  return dynamic_cast<const ContentsOf<T>&>(*message.contents).content;
}

/// A message passed within a processor: either a copy, or a pointer of one word.
struct Handed {
  Message message;
  bool by_pointer = false;
  std::uint64_t bytes() const { return by_pointer ? 4 : message.bytes(); }
};

struct Node;

/// Ways in and out of a router have numbers: the port of a link, or CLIENT + n for client n.
constexpr int CLIENT = topologies::PORTS;
constexpr int MAX_CLIENTS = 4;
constexpr int WAYS = CLIENT + MAX_CLIENTS;
constexpr int NO_WAY = -1;  ///< the way in of a message that this processor sends again

/// The fault that a router has no free buffer for a message.
struct Overflow : machine::Fault {
  using Fault::Fault;
};

/// Numbers of messages handled by a router.
struct RouterUse {
  std::uint64_t taken = 0;  ///< messages received from clients
  /// Messages passed from link to link ("EE" in table 5.1 of the thesis).
  std::uint64_t passed = 0;
  std::uint64_t delivered = 0;  ///< messages delivered to clients, except returned ones
  std::uint64_t returned = 0;   ///< undeliverable messages sent back to their sender
  std::uint64_t lost = 0;       ///< messages neither delivered nor returned
  std::size_t most_held = 0;    ///< maximum number of messages in the queues

  RouterUse& operator+=(const RouterUse& other);  ///< adds all numbers except most_held
};

/// Cycles of a router's operations, from the section [operation] of the model file, with the factor
/// for compiled code.
struct RouterCosts {
  RouterCosts() = default;
  explicit RouterCosts(const machine::Model& model);
  occam::Cycles route_found, tree_way_looked_at, way_served;
  occam::Cycles fifo_looked_at, fifo_step, buffer_shared;
  occam::Cycles copy_setup, copy_word;
};

/// The ways by which a message leaves a processor.
struct WaysOut {
  std::array<std::int8_t, WAYS> way{};
  std::size_t count = 0;
  void add(int w) { way.at(count++) = static_cast<std::int8_t>(w); }
  const std::int8_t* begin() const { return way.data(); }
  const std::int8_t* end() const { return way.data() + count; }
};

/// A way in, as an input of the replicated guard occam::each: `way ? message`. Yields no message if
/// the way's link is cut.
struct WayIn {
  Node* node;
  int way;
};
occam::ChannelBase& channel_of(const WayIn& input);
std::optional<Message> input_from(const WayIn& input);

struct Node {
  int id = 0;
  machine::Processor* processor = nullptr;
  const Routing* routing = nullptr;
  std::size_t buffers = 0;  ///< number of messages that the queues can hold
  bool pointers = true;     ///< passes pointers instead of copies, see Params
  RouterCosts costs;
  std::array<Channel<Message>*, topologies::PORTS> link_in{}, link_out{};
  std::vector<Channel<Handed>*> client_in, client_out;
  /// For each client: the set of process numbers for which it receives messages, one bit each.
  std::vector<std::uint32_t> processes;
  RouterUse use;
  std::size_t held = 0;  ///< number of messages now in the queues

  std::vector<int> ways() const;  ///< all ways; each of them leads both in and out
  std::vector<WayIn> inputs();    ///< all ways, as inputs of an ALT

  /// Inputs a message from this way: `channel ? message`. Returns nothing if the link is cut.
  std::optional<Message> take(int way);
  /// Outputs a message to this way: `channel ! message`. Returns false if the link is cut.
  bool pass(int way, const Message& message);
  /// Determines the ways out for a message that came by `came_by` (determ.ways.out in figure 5.14
  /// of the thesis). An undeliverable message is addressed to its sender instead. If there is no
  /// way to the sender either, returns no ways. If pointers are passed, also charges the allocation
  /// and release of a buffer for each way.
  WaysOut find_ways_out(Message& message, int came_by);
  /// Removes and returns the copies of broadcast (GLOBAL) messages that must return to this
  /// processor's client: one for each processor that a message cannot reach. The caller must send
  /// these copies next.
  std::vector<Message> take_unreached() { return std::exchange(unreached_, {}); }
  /// Returns the messages that this processor must send instead of a message that could not leave
  /// by `way` because the link was cut.
  std::vector<Message> send_around(Message message, int way);

  /// Reserves a buffer for the message. If copies are passed, charges the copy to the buffer.
  /// Throws Overflow if no buffer is free.
  void hold(const Message& message);
  void release(const Message& message);
  /// Charges the operation of finding that a queue is empty.
  void charge_empty_fifo() const;

 private:
  WaysOut determine_ways(Message& message, int came_by);
  int client_of(int process) const;  // returns the way to the client, or NO_WAY
  void turn_back(Message& message, Returned reason);
  void charge_step(const Message& message) const;
  void note_unreached(const Message& message);

  int choose_link(const Message& message, int port) const;

  std::vector<Message> unreached_;
};

}  // namespace network

#pragma once
// The state of a router on its processor: ways in and out, tables, and memory for messages. Routers
// pass messages between processes of any two processors (figure 5.5).
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

/// Interpretation of the first level of an address (5.1.1.1 to 5.1.1.3).
enum class Mode : std::uint8_t {
  unicast,     ///< to one processor
  global,      ///< to this process on all other processors; `processor` is ignored
  in_path_to,  ///< offered to the process on every processor along the route to `processor`
};

constexpr int MAX_PROCESSES = 32;

/// A two-level address: a processor, and a process on it.
struct Address {
  int processor = 0;
  /// Kind of process, 0 to MAX_PROCESSES - 1. A processor has at most one process of each kind.
  int process = 0;
  Mode mode = Mode::unicast;
  bool operator==(const Address&) const = default;
};
constexpr Address make_global(int process) { return {0, process, Mode::global}; }

/// Reason why a message was returned to its sender.
enum class Returned : std::uint8_t { no, no_processor, no_process, no_route };
std::string_view to_string(Returned reason);

/// Contents of a message, opaque to routers.
struct Contents {
  virtual ~Contents() = default;
};
/// Contents of type T, such as a variant of all messages of a program.
template <class T>
struct ContentsOf final : Contents {
  explicit ContentsOf(T of) : content(std::move(of)) {}
  const T content;
};

struct Message {
  Address to = {}, from = {};
  std::uint64_t length = 0;  ///< length of `contents` in bytes
  std::uint64_t number = 0;  ///< not used by routers; available to the sender
  std::shared_ptr<const Contents> contents = {};
  Returned returned = Returned::no;
  int links = 0;         ///< number of links passed so far
  std::size_t tree = 0;  ///< for GLOBAL messages: Routing::epoch() at the time of sending

  /// Size of the header in bytes: address, sender and length, five words (the speed column of table
  /// 5.3).
  static constexpr std::uint64_t IDENTIFICATION = 20;
  std::uint64_t bytes() const { return IDENTIFICATION + length; }
};

/// Makes a message. If it cannot be delivered, `process` of the sender receives it back.
template <class T>
Message make_message(int process, const Address& to, std::uint64_t length, T content) {
  return {.to = to,
          .from = {.process = process},
          .length = length,
          .contents = std::make_shared<const ContentsOf<T>>(std::move(content))};
}
/// The contents of a message. Throws std::bad_cast if they are not a T.
template <class T>
const T& read(const Message& message) {
  return dynamic_cast<const ContentsOf<T>&>(*message.contents).content;
}

/// A message passed within a processor, either copied or as a pointer of one word.
struct Handed {
  Message message;
  bool by_pointer = false;
  std::uint64_t bytes() const { return by_pointer ? 4 : message.bytes(); }
};

struct Node;

/// Ways are numbered: a way is the port of a link, or CLIENT + n for client n of the processor.
constexpr int CLIENT = topologies::PORTS;
constexpr int MAX_CLIENTS = 4;
constexpr int WAYS = CLIENT + MAX_CLIENTS;
constexpr int NO_WAY = -1;  ///< instead of the way in of a message that is sent again

/// Fault: a router has no free buffer for a message.
struct Overflow : machine::Fault {
  using Fault::Fault;
};

/// Numbers of messages handled by a router.
struct RouterUse {
  std::uint64_t taken = 0;      ///< received from clients
  std::uint64_t passed = 0;     ///< passed from link to link ("EE" in table 5.1)
  std::uint64_t delivered = 0;  ///< delivered to clients, without returned messages
  std::uint64_t returned = 0;   ///< sent back to their sender as undeliverable
  std::uint64_t lost = 0;       ///< neither delivered nor returned
  std::size_t most_held = 0;    ///< maximum length of the queues

  RouterUse& operator+=(const RouterUse& other);  ///< adds, except most_held
};

/// Cycles of a router's operations in compiled code, from the model's [operation].
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

/// A way in, as an input of occam::each: `way ? message`. Yields no message if the way's link is
/// cut.
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
  std::size_t buffers = 0;  ///< capacity of the queues in messages
  bool pointers = true;     ///< true: pass pointers, see Params
  RouterCosts costs;
  std::array<Channel<Message>*, topologies::PORTS> link_in{}, link_out{};
  std::vector<Channel<Handed>*> client_in, client_out;
  std::vector<std::uint32_t> processes;  ///< by client; bit sets of processes
  RouterUse use;
  std::size_t held = 0;  ///< number of messages in the queues

  std::vector<int> ways() const;  ///< all ways; each leads both in and out
  std::vector<WayIn> inputs();    ///< all ways, as inputs

  /// `channel ? message` from this way; returns nothing if the link is cut.
  std::optional<Message> take(int way);
  /// `channel ! message` to this way; returns false if the link is cut.
  bool pass(int way, const Message& message);
  /// Determines the ways out for a message that came by `came_by` (determ.ways.out in figure 5.14).
  /// Redirects an undeliverable message to its sender. If there is no way to the sender either,
  /// returns no ways. With pointers, also charges the allocation and release of a buffer for each
  /// way.
  WaysOut find_ways_out(Message& message, int came_by);
  /// Messages to be returned to this processor's client: one for each processor that the tree of
  /// the client's GLOBAL message does not reach. The caller sends them next.
  std::vector<Message> take_unreached() { return std::exchange(unreached_, {}); }
  /// Replacements for a message whose link `way` was cut, to be sent from this processor.
  std::vector<Message> send_around(Message message, int way);

  /// Reserves a buffer for the message. Without pointers, charges the copy to the buffer. Throws
  /// Overflow.
  void hold(const Message& message);
  void release(const Message& message);
  /// Charges the test of an empty queue.
  void charge_empty_fifo() const;

 private:
  WaysOut determine_ways(Message& message, int came_by);
  int client_of(int process) const;  // returns a way, or NO_WAY
  void turn_back(Message& message, Returned reason);
  void charge_step(const Message& message) const;
  void note_unreached(const Message& message);

  int choose_link(const Message& message, int port) const;

  std::vector<Message> unreached_;
};

}  // namespace network

#pragma once
// Messages between processes of any two processors (figure 5.5). Node: a router's data on its
// processor, that is its ways in and out, its tables, and room for messages.
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

/// Meaning of the first level of an address (5.1.1.1 to 5.1.1.3).
enum class Mode : std::uint8_t {
  unicast,     ///< one processor
  global,      ///< all other processors with this process; `processor` is not used
  in_path_to,  ///< offered to the addressed process on every processor on the way to `processor`
};

constexpr int MAX_PROCESSES = 32;

/// Addresses have two levels: a processor, and a process there.
struct Address {
  int processor = 0;
  /// A kind of process, 0 to MAX_PROCESSES - 1; a processor has at most one of each.
  int process = 0;
  Mode mode = Mode::unicast;
  bool operator==(const Address&) const = default;
};
constexpr Address make_global(int process) { return {0, process, Mode::global}; }

/// Reason for the return of a message to its sender.
enum class Returned : std::uint8_t { no, no_processor, no_process, no_route };
std::string_view to_string(Returned reason);

/// Contents of a message; routers do not read them.
struct Contents {
  virtual ~Contents() = default;
};

struct Message {
  Address to = {}, from = {};
  std::uint64_t length = 0;  ///< bytes of the contents
  std::uint64_t number = 0;  ///< free for the sender's use
  std::shared_ptr<const Contents> contents = {};
  Returned returned = Returned::no;
  int links = 0;         ///< number of links passed so far
  std::size_t tree = 0;  ///< for GLOBAL: Routing::epoch() at the time of sending

  /// The identification: address, sender and length, five words (the speed column of table 5.3).
  static constexpr std::uint64_t IDENTIFICATION = 20;
  std::uint64_t bytes() const { return IDENTIFICATION + length; }
};

/// A message passed within a processor: copied, or by a pointer (one word).
struct Handed {
  Message message;
  bool by_pointer = false;
  std::uint64_t bytes() const { return by_pointer ? 4 : message.bytes(); }
};

struct Node;

/// Ways: a way is the port of a link, or CLIENT + n for the processor's client number n.
constexpr int CLIENT = topologies::PORTS;
constexpr int MAX_CLIENTS = 4;
constexpr int WAYS = CLIENT + MAX_CLIENTS;
constexpr int NO_WAY = -1;  ///< way in of a message that this router itself sends again

/// A router has no room for a message.
struct Overflow : machine::Fault {
  using Fault::Fault;
};

/// Messages handled by a router.
struct RouterUse {
  std::uint64_t taken = 0;      ///< from clients
  std::uint64_t passed = 0;     ///< from one link to another ("EE" in table 5.1), upon arrival
  std::uint64_t delivered = 0;  ///< to clients, without returned ones
  std::uint64_t returned = 0;   ///< to their sender, being undeliverable
  std::uint64_t lost = 0;       ///< not returnable either
  std::size_t most_held = 0;    ///< maximum held at once

  RouterUse& operator+=(const RouterUse& other);  ///< sums; maximum of most_held
};

/// Cycles of a router's operations in compiled code: the model's [operation].
struct RouterCosts {
  RouterCosts() = default;
  explicit RouterCosts(const machine::Model& model);
  occam::Cycles route_found, tree_way_looked_at, way_served;
  occam::Cycles fifo_looked_at, fifo_step, buffer_shared;
  occam::Cycles copy_setup, copy_word;
};

/// The ways of a message out of a processor.
struct WaysOut {
  std::array<std::int8_t, WAYS> way{};
  std::size_t count = 0;
  void add(int w) { way.at(count++) = static_cast<std::int8_t>(w); }
  const std::int8_t* begin() const { return way.data(); }
  const std::int8_t* end() const { return way.data() + count; }
};

/// A way in, as an input of occam::each: `way ? message`. Gives no message if its link is cut.
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
  std::size_t buffers = 0;  ///< capacity of the queues, in messages
  bool pointers = true;     ///< see Params
  RouterCosts costs;
  std::array<Channel<Message>*, topologies::PORTS> link_in{}, link_out{};
  std::vector<Channel<Handed>*> client_in, client_out;
  std::vector<std::uint32_t> processes;  ///< by client, a bit for each process
  RouterUse use;
  std::size_t held = 0;  ///< messages in the queues

  std::vector<int> ways() const;  ///< ways in, which are also the ways out
  std::vector<WayIn> inputs();    ///< all ways in

  /// `channel ? message`; nothing if the link is cut.
  std::optional<Message> take(int way);
  /// `channel ! message`; false if the link is cut.
  bool pass(int way, const Message& message);
  /// determ.ways.out of figure 5.14: the ways out for a message that came by this way. An
  /// undeliverable message turns back to its sender; without a way there, the result is empty. With
  /// pointers, also charges the claim and release of a buffer for each way.
  WaysOut find_ways_out(Message& message, int came_by);
  /// Messages to send next from here; they will be returned. One for each processor not reached by
  /// the tree of a GLOBAL message of this processor.
  std::vector<Message> take_unreached() { return std::exchange(unreached_, {}); }
  /// Replacements to send from here for a message after a cut of its link `way`.
  std::vector<Message> send_around(Message message, int way);

  /// Takes room for one more message; copies it unless pointers are used. Throws Overflow.
  void hold(const Message& message);
  void release(const Message& message);
  /// Charges the look at an empty queue.
  void charge_empty_fifo() const;

 private:
  WaysOut determine_ways(Message& message, int came_by);
  int client_of(int process) const;  // a way, or NO_WAY
  void turn_back(Message& message, Returned reason);
  void charge_step(const Message& message) const;
  void note_unreached(const Message& message);

  int choose_link(const Message& message, int port) const;

  std::vector<Message> unreached_;
};

}  // namespace network

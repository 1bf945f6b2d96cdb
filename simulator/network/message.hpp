#pragma once
// Messages between processes of any two processors (figure 5.5). Addresses have two levels: a
// processor, and a process there.
#include <cstdint>
#include <memory>
#include <string_view>

namespace network {

/// How the first level of an address is meant (5.1.1.1 to 5.1.1.3).
enum class Mode : std::uint8_t {
  unicast,     ///< the one processor
  global,      ///< every processor but the sender's that has the process; `processor` is not used
  in_path_to,  ///< offered to the addressed process on every processor on the way to this one
};

constexpr int MAX_PROCESSES = 32;

struct Address {
  int processor = 0;
  /// A kind of process, 0 to MAX_PROCESSES - 1; a processor has at most one of each.
  int process = 0;
  Mode mode = Mode::unicast;
  bool operator==(const Address&) const = default;
};
constexpr Address make_global(int process) { return {0, process, Mode::global}; }

/// Why a message has come back to its sender.
enum class Returned : std::uint8_t { no, no_processor, no_process, no_route };
std::string_view to_string(Returned reason);

/// What a message says; routers do not look.
struct Contents {
  virtual ~Contents() = default;
};

struct Message {
  Address to, from;
  std::uint64_t length = 0;  ///< bytes of the contents
  std::uint64_t number = 0;  ///< free for the sender's use
  std::shared_ptr<const Contents> contents;
  Returned returned = Returned::no;
  int links = 0;         ///< passed so far
  std::size_t tree = 0;  ///< of a GLOBAL message, Routing::epoch() when it was sent

  /// The identification: address, sender and length, five words (the speed column of table 5.3).
  static constexpr std::uint64_t IDENTIFICATION = 20;
  std::uint64_t bytes() const { return IDENTIFICATION + length; }
};

/// A message on its way within a processor: copied, or known by a pointer, which is a word.
struct Handed {
  Message message;
  bool by_pointer = false;
  std::uint64_t bytes() const { return by_pointer ? 4 : message.bytes(); }
};

}  // namespace network

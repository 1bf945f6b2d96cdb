#pragma once
// What data managers say to each other.
#include "simulator/network/message.hpp"

namespace shared_memory {

// The second level of an address. An application's own kinds of process follow.
constexpr int DATA_PROCESS = 0;
constexpr int FIRST_FREE_PROCESS = 1;

// Where a record was found, nearest first.
enum class Level : std::uint8_t {
  local,        // the processor's own memory
  path,         // the cache of another one: on the way to the coordinator, or who keeps the page
  queue,        // with the reply to another one that had asked before (WRQu)
  coordinator,  // its cache
  disk,
};
constexpr std::size_t LEVELS = 5;

// A record is an item, or a page of items.
struct DataMessage : network::Contents {
  bool is_reply = false;
  std::size_t record = 0;
  Level level = Level::local;  // of a reply
  int links = 0;               // of a reply: that its request had passed
};

}  // namespace shared_memory

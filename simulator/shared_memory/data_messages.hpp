#pragma once
// What data managers say to each other.
#include <variant>

#include "simulator/network/message.hpp"

namespace shared_memory {

/// The second level of an address. An application's own kinds of process follow.
constexpr int DATA_PROCESS = 0;
constexpr int FIRST_FREE_PROCESS = 1;

/// Where a record was found, nearest first.
enum class Level : std::uint8_t {
  local,        ///< the processor's own memory
  path,         ///< another one's cache: on the way to the coordinator, or that of the page's owner
  queue,        ///< with the reply to another one that had asked before (WRQu)
  coordinator,  ///< its cache
  disk,
};
constexpr std::size_t LEVELS = 5;

/// Asks for a record: an item, or a page of items.
struct DataRequest {
  std::size_t record = 0;
};
struct DataReply {
  std::size_t record = 0;
  Level level = Level::local;
  int links = 0;  ///< that the request had passed
};
struct DataMessage : network::Contents {
  explicit DataMessage(std::variant<DataRequest, DataReply> content) : content(content) {}
  std::variant<DataRequest, DataReply> content;
};

}  // namespace shared_memory

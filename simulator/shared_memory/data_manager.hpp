#pragma once
// Virtual shared memory (5.1.2): on every processor a manager that finds data for the application
// there, and answers what others ask. It has no process of its own (LSGP), but in a node of two
// processors (cache_manager.hpp): the application calls it, and whenever it does the manager looks
// at the channel from the router.
#include <array>
#include <deque>
#include <variant>

#include "base/fields.hpp"
#include "simulator/network/network.hpp"
#include "simulator/shared_memory/items.hpp"
#include "simulator/shared_memory/lru_cache.hpp"

namespace shared_memory {

using machine::Cycles;
using machine::Seconds;

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
/// What data managers say to each other.
struct DataMessage : network::Contents {
  explicit DataMessage(std::variant<DataRequest, DataReply> content) : content(content) {}
  std::variant<DataRequest, DataReply> content;
};

struct DataUse {
  std::array<std::uint64_t, LEVELS> found{};  ///< accesses, by Level of the item
  std::uint64_t requests = 0;                 ///< sent
  std::uint64_t request_links = 0;            ///< links that they passed until they were answered
  /// Links that the requests were spared, of those to the processor that they were addressed to.
  std::uint64_t spared_by_path = 0, spared_by_queue = 0;
  std::uint64_t seen = 0;  ///< requests of others; each was one of these:
  std::uint64_t answered = 0, queued = 0, passed_on = 0;
  Seconds waited{};  ///< for replies

  std::uint64_t accesses() const;
  std::uint64_t found_at(Level level) const { return found[static_cast<std::size_t>(level)]; }
  DataUse& operator+=(const DataUse& other);
  DataUse& operator-=(const DataUse& earlier);
};

/// The columns accesses_made, where items were found, requests, and what these took or were spared.
/// Shares of nothing are 0.
base::Columns<DataUse> data_columns();

/// Cycles of a manager's work: the model's [operation] data_*.
struct DataCosts {
  explicit DataCosts(const machine::Model& model);
  Cycles look_up, touch, insert, drop;
  std::uint64_t request_bytes, reply_bytes;  ///< a reply has the record too
  Seconds idle_period;
};

/// What a manager works with.
struct DataManagerMeans {
  network::Client& client;
  const network::Routing& routing;
  DataCosts costs;
  LruCache cache;
};

class DataManager {
 public:
  explicit DataManager(DataManagerMeans means)
      : costs_(means.costs),
        routing_(means.routing),
        cache_(std::move(means.cache)),
        client_(means.client) {}
  virtual ~DataManager() = default;
  DataManager(const DataManager&) = delete;
  DataManager& operator=(const DataManager&) = delete;

  /// Returns when the application may read the item (figure 5.21). Serves others first.
  virtual void access(Item item) = 0;
  /// Serves what waits on the channel from the router (figure 5.20).
  void look();
  /// For an application that has work: serves what waits, and returns a message that is for no data
  /// manager if one has come.
  std::optional<network::Message> take_other();
  /// For an application without work: serves others until a message comes that is for no data
  /// manager, and returns that. Looks at the channel every idle period.
  network::Message serve() { return serve_every(costs_.idle_period); }
  /// The same for an application that waits in an ALT until something comes: serves at once.
  network::Message serve_at_once() { return serve_every({}); }
  /// The same up to a tick of the timer (see occam::wait_until); then nothing is returned.
  std::optional<network::Message> serve_until(std::int64_t tick);
  /// The same for an application that has ended: its process becomes a server, and never returns.
  [[noreturn]] void serve_for_ever();

  network::Client& client() { return client_; }
  const DataUse& use() const { return use_; }
  const LruCache& cache() const { return cache_; }

 protected:
  virtual void handle_request(const network::Message& message, const DataRequest& request) = 0;
  virtual void handle_reply(const DataReply& reply) = 0;

  void count(Level level) { ++use_.found[static_cast<std::size_t>(level)]; }
  /// Asks `to` for a record, and serves until handle_reply has seen it.
  void fetch(std::size_t record, network::Address to);
  /// Sends a record to the processor that asked for it, by a request that had passed `links`.
  void reply(network::Address to, std::size_t record, std::uint64_t bytes, Level level, int links);
  /// Whether the cache holds a record, which is charged and becomes the most recent.
  bool touch(std::size_t record);
  /// Puts a record into the cache; it is charged, and each that leaves it.
  void insert(std::size_t record);
  /// Serves a message for data managers; keeps one that is for another process.
  void take(network::Message message);

  const DataCosts costs_;
  const network::Routing& routing_;
  LruCache cache_;
  DataUse use_;

 private:
  void send(network::Address to, std::uint64_t bytes, const DataMessage& contents);
  void wait_for_message(Seconds period);
  network::Message serve_every(Seconds period);

  network::Client& client_;
  bool has_reply_ = false;
  std::deque<network::Message> others_;  // for no data manager
};

}  // namespace shared_memory

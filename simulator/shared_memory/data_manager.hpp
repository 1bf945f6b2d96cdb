#pragma once
// Virtual shared memory (5.1.2). Each processor has a manager that finds data for its application
// and answers requests of others. It has no process of its own (LSGP): the application calls it,
// and every call also serves the channel from the router. Nodes of two processors differ
// (cache_manager.hpp).
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

/// Second level of an address. Process kinds of an application follow.
constexpr int DATA_PROCESS = 0;
constexpr int FIRST_FREE_PROCESS = 1;

/// Place where a record was found, nearest first.
enum class Level : std::uint8_t {
  local,        ///< the processor's own memory
  path,         ///< another processor's cache: on the way to the coordinator, or the page owner's
  queue,        ///< arrived with the reply to an earlier request of another processor (WRQu)
  coordinator,  ///< the coordinator's cache
  disk,
};
constexpr std::size_t LEVELS = 5;

/// Request for a record: an item, or a page of items.
struct DataRequest {
  std::size_t record = 0;
};
struct DataReply {
  std::size_t record = 0;
  Level level = Level::local;
  int links = 0;  ///< links that the request passed
};
/// Message between data managers.
struct DataMessage : network::Contents {
  explicit DataMessage(std::variant<DataRequest, DataReply> content) : content(content) {}
  std::variant<DataRequest, DataReply> content;
};

struct DataUse {
  std::array<std::uint64_t, LEVELS> found{};  ///< accesses, by Level of the item
  std::uint64_t requests = 0;                 ///< sent
  std::uint64_t request_links = 0;            ///< links passed until they were answered
  /// Links saved by caches and queues, compared with the distance to the addressee.
  std::uint64_t spared_by_path = 0, spared_by_queue = 0;
  std::uint64_t seen = 0;  ///< requests of others; sum of the next three
  std::uint64_t answered = 0, queued = 0, passed_on = 0;
  Seconds waited{};  ///< time waiting for replies

  std::uint64_t accesses() const;
  std::uint64_t found_at(Level level) const { return found[static_cast<std::size_t>(level)]; }
  DataUse& operator+=(const DataUse& other);
  DataUse& operator-=(const DataUse& earlier);
};

/// Columns: accesses_made, places of the items found, requests and their links, spared links,
/// waits. Shares are 0 without accesses or requests.
base::Columns<DataUse> data_columns();

/// Cycles of a manager's operations: [operation] data_* of the model.
struct DataCosts {
  explicit DataCosts(const machine::Model& model);
  Cycles look_up, touch, insert, drop;
  std::uint64_t request_bytes, reply_bytes;  ///< a reply also contains the record
  Seconds idle_period;
};

/// Resources of a manager.
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
  /// Serves all messages waiting on the channel from the router (figure 5.20).
  void look();
  /// For an application with work: serves waiting messages, and returns a message for another
  /// process if there is one.
  std::optional<network::Message> take_other();
  /// For an application without work: serves others until a message for another process arrives,
  /// and returns it. Checks the channel once every idle period.
  network::Message serve() { return serve_every(costs_.idle_period); }
  /// As serve(), for an application that waits in an ALT: each message is served on arrival.
  network::Message serve_at_once() { return serve_every({}); }
  /// As serve_at_once() up to a timer tick (see occam::wait_until); then returns none.
  std::optional<network::Message> serve_until(std::int64_t tick);
  /// For an application that has ended: makes its process a server that never returns.
  [[noreturn]] void serve_for_ever();

  network::Client& client() { return client_; }
  const DataUse& use() const { return use_; }
  const LruCache& cache() const { return cache_; }

 protected:
  virtual void handle_request(const network::Message& message, const DataRequest& request) = 0;
  virtual void handle_reply(const DataReply& reply) = 0;

  void count(Level level) { ++use_.found[static_cast<std::size_t>(level)]; }
  /// Requests a record from `to`, and serves until handle_reply has received it.
  void fetch(std::size_t record, network::Address to);
  /// Sends a record to its requester; the request had passed `links`.
  void reply(network::Address to, std::size_t record, std::uint64_t bytes, Level level, int links);
  /// True if the cache holds a record; charges the access and makes it the most recent.
  bool touch(std::size_t record);
  /// Inserts a record into the cache; charges the insertion and each evicted record.
  void insert(std::size_t record);
  /// Serves a message for data managers; keeps one for another process.
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
  std::deque<network::Message> others_;  // for other processes
};

}  // namespace shared_memory

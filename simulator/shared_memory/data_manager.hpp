#pragma once
// Virtual shared memory (5.1.2). Each processor has a data manager, which finds data for its
// application and answers requests of others. It is not a process (LSGP): the application calls it,
// and every call also serves messages from the router. For nodes of two processors see
// cache_manager.hpp.
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

/// Numbers of processes in addresses. The numbers of an application's processes start at
/// FIRST_FREE_PROCESS.
constexpr int DATA_PROCESS = 0;
constexpr int FIRST_FREE_PROCESS = 1;

/// Place where a record was found, from near to far.
enum class Level : std::uint8_t {
  local,        ///< the processor's own memory
  path,         ///< a cache on the route to the coordinator; with pages, the page's owner
  queue,        ///< a processor on the route that waited for the same record (WRQu)
  coordinator,  ///< the coordinator's cache
  disk,
};
constexpr std::size_t LEVELS = 5;

/// Request for a record, which is an item or a page of items.
struct DataRequest {
  std::size_t record = 0;
};
struct DataReply {
  std::size_t record = 0;
  Level level = Level::local;
  int links = 0;  ///< number of links passed by the request
};
/// A message between data managers.
using DataMessage = std::variant<DataRequest, DataReply>;

struct DataUse {
  std::array<std::uint64_t, LEVELS> found{};  ///< number of accesses, by Level of the item
  std::uint64_t requests = 0;                 ///< number of requests sent
  std::uint64_t request_links = 0;            ///< number of links passed by requests until answered
  /// Links that requests did not pass because a cache or a queue on the way answered them.
  std::uint64_t spared_by_path = 0, spared_by_queue = 0;
  std::uint64_t seen = 0;  ///< number of requests received from others; total of the next three
  std::uint64_t answered = 0, queued = 0, passed_on = 0;
  Seconds waited{};  ///< time spent waiting for replies

  std::uint64_t accesses() const;
  std::uint64_t found_at(Level level) const { return found[static_cast<std::size_t>(level)]; }
  DataUse& operator+=(const DataUse& other);
  DataUse& operator-=(const DataUse& earlier);
};

/// The columns: accesses_made, places where items were found, requests and their links, saved
/// links, and waits. Without accesses or requests, fractions are 0.
base::Columns<DataUse> data_columns();

/// Costs of a manager's operations, from the model's [operation] data_*.
struct DataCosts {
  explicit DataCosts(const machine::Model& model);
  Cycles look_up, touch, insert, drop;
  std::uint64_t request_bytes, reply_bytes;  ///< sizes of messages, without the record
  Seconds idle_period;
};

/// The resources that a manager uses.
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

  /// Makes the item readable for the application (figure 5.21); returns when it is. First serves
  /// requests of others.
  virtual void access(Item item) = 0;
  /// Serves all messages that have arrived from the router (figure 5.20).
  void look();
  /// For an application with work: serves all messages that have arrived. Returns the first message
  /// for another process, or none.
  std::optional<network::Message> take_other();
  /// For an application without work: serves requests until a message for another process arrives,
  /// and returns that message. Polls once per idle period.
  network::Message serve() { return serve_every(costs_.idle_period); }
  /// Like serve(), for an application that waits in an ALT: serves each message on arrival.
  network::Message serve_at_once() { return serve_every({}); }
  /// Like serve_at_once(), but returns none at the given timer tick (see occam::wait_until).
  std::optional<network::Message> serve_until(std::int64_t tick);
  /// For an application that has ended: makes its process a server and never returns.
  [[noreturn]] void serve_for_ever();

  network::Client& client() { return client_; }
  const DataUse& use() const { return use_; }
  const LruCache& cache() const { return cache_; }

 protected:
  virtual void handle_request(const network::Message& message, const DataRequest& request) = 0;
  virtual void handle_reply(const DataReply& reply) = 0;

  void count(Level level) { ++use_.found[static_cast<std::size_t>(level)]; }
  /// Requests a record from `to`, and serves messages until handle_reply has been called.
  void fetch(std::size_t record, network::Address to);
  /// Sends a record to its requester. `links` is the number of links that the request had passed.
  void reply(network::Address to, std::size_t record, std::uint64_t bytes, Level level, int links);
  /// Returns true if the cache holds the record. If so, charges the access and makes the record the
  /// most recently used.
  bool touch(std::size_t record);
  /// Inserts a record into the cache. Charges the insertion and each eviction.
  void insert(std::size_t record);
  /// Serves a message to the data manager; stores a message to another process.
  void take(network::Message message);

  const DataCosts costs_;
  const network::Routing& routing_;
  LruCache cache_;
  DataUse use_;

 private:
  void send(network::Address to, std::uint64_t bytes, DataMessage content);
  void wait_for_message(Seconds period);
  network::Message serve_every(Seconds period);

  network::Client& client_;
  bool has_reply_ = false;
  std::deque<network::Message> others_;  // messages for other processes
};

}  // namespace shared_memory

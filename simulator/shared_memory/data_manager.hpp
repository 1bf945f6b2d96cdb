#pragma once
// Virtual shared memory (thesis, 5.1.2). Each processor has a data manager, which finds data for
// the application and answers requests of other processors. It is not a process of its own: the
// application calls it, and each call also serves messages from the router. The file
// cache_manager.hpp has a variant for nodes of two processors.
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

/// Numbers of processes in network addresses. An application may use the numbers from
/// FIRST_FREE_PROCESS on.
constexpr int DATA_PROCESS = 0;
constexpr int FIRST_FREE_PROCESS = 1;

/// Place where a record was found, from the nearest to the farthest.
enum class Level : std::uint8_t {
  local,        ///< memory of the processor itself
  path,         ///< a cache on the route to the coordinator; if pages are used, the page's owner
  queue,        ///< a processor on the route that already waited for the same record (WRQu)
  coordinator,  ///< cache of the coordinator
  disk,
};
constexpr std::size_t LEVELS = 5;

/// Request for a record, which is either an item or a page of items.
struct DataRequest {
  std::size_t record = 0;
};
struct DataReply {
  std::size_t record = 0;
  Level level = Level::local;
  int links = 0;  ///< number of links that the request passed
};
/// A message between data managers.
using DataMessage = std::variant<DataRequest, DataReply>;

struct DataUse {
  /// Number of accesses, by the Level at which the item was found.
  std::array<std::uint64_t, LEVELS> found{};
  std::uint64_t requests = 0;       ///< number of requests sent
  std::uint64_t request_links = 0;  ///< number of links that answered requests passed
  /// Number of links that requests did not have to pass, because a cache or a waiting queue on the
  /// route answered them.
  std::uint64_t spared_by_path = 0, spared_by_queue = 0;
  /// Number of requests received from other processors: the sum of `answered`, `queued` and
  /// `passed_on`.
  std::uint64_t seen = 0;
  std::uint64_t answered = 0, queued = 0, passed_on = 0;
  Seconds waited{};  ///< total time spent waiting for replies

  std::uint64_t accesses() const;
  std::uint64_t found_at(Level level) const { return found[static_cast<std::size_t>(level)]; }
  DataUse& operator+=(const DataUse& other);
  DataUse& operator-=(const DataUse& earlier);
};

/// The columns of a result: accesses, places where items were found, requests and the links they
/// passed, links saved, and waiting times. If there are no accesses or requests, their fractions
/// are 0.
base::Columns<DataUse> data_columns();

/// Costs of a data manager's operations, from the entries operation.data_* of the model.
struct DataCosts {
  explicit DataCosts(const machine::Model& model);
  Cycles look_up, touch, insert, drop;
  std::uint64_t request_bytes, reply_bytes;  ///< lengths of messages without the record
  Seconds idle_period;
};

/// The objects that a data manager works with.
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

  /// Makes the item readable for the application (thesis, figure 5.21) and then returns. First
  /// serves requests of other processors.
  virtual void access(Item item) = 0;
  /// Serves all messages that have arrived from the router (thesis, figure 5.20).
  void look();
  /// For an application that has work to do: serves all messages that have arrived. Returns the
  /// first message for another process of this processor, or nothing.
  std::optional<network::Message> take_other();
  /// For an application that has no work: serves requests until a message for another process of
  /// this processor arrives, and returns that message. Polls once per idle period.
  network::Message serve() { return serve_every(costs_.idle_period); }
  /// Does the same as serve(), but does not poll: waits in an ALT and serves each message on
  /// arrival.
  network::Message serve_at_once() { return serve_every({}); }
  /// Does the same as serve_at_once(), but returns nothing at the timer tick `tick`
  /// (occam::wait_until).
  std::optional<network::Message> serve_until(std::int64_t tick);
  /// For an application that has ended: makes its process a server, which need not end. Never
  /// returns.
  [[noreturn]] void serve_for_ever();

  network::Client& client() { return client_; }
  const DataUse& use() const { return use_; }
  const LruCache& cache() const { return cache_; }

 protected:
  virtual void handle_request(const network::Message& message, const DataRequest& request) = 0;
  virtual void handle_reply(const DataReply& reply) = 0;

  void count(Level level) { ++use_.found[static_cast<std::size_t>(level)]; }
  /// Requests a record from `to`, then serves messages until the reply has been handled.
  void fetch(std::size_t record, network::Address to);
  /// Sends a record to the processor that requested it. `links` is the number of links that the
  /// request passed.
  void reply(network::Address to, std::size_t record, std::uint64_t bytes, Level level, int links);
  /// Returns true if the cache holds the record. In this case charges the access, and makes the
  /// record the most recently used one.
  bool touch(std::size_t record);
  /// Inserts a record into the cache. Charges the insertion and each record that is evicted.
  void insert(std::size_t record);
  /// Serves a message if it is for the data manager; otherwise stores it in others_.
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
  std::deque<network::Message> others_;  // messages for other processes of this processor
};

}  // namespace shared_memory

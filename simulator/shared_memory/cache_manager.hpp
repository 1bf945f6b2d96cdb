#pragma once
// A data manager with a cache, and a variant for a node of two processors that share a memory
// (thesis, 6.2). In such a node, the manager is a process on the processor that has the links. It
// serves requests of other processors at once, while the application computes on the companion.
#include <deque>

#include "simulator/shared_memory/data_manager.hpp"

namespace shared_memory {

class CacheManager : public DataManager {
 public:
  using DataManager::DataManager;

  // Finds the item, or requests it and waits (thesis, figure 5.21).
  void access(Item item) override;

  virtual std::size_t record_of(Item item) const = 0;
  /// True if the record is always in local memory, outside of the cache.
  virtual bool is_resident(std::size_t /*record*/) const { return false; }
  bool holds(std::size_t record) const { return is_resident(record) || cache_.holds(record); }
  /// Requests a record that is not in local memory, and returns when it has arrived.
  virtual void ask(std::size_t record) = 0;
  /// Moves a record that was accessed to the top of the cache's LRU list.
  void note_access(std::size_t record) { touch(record); }
  void serve_one(network::Message message) { take(std::move(message)); }
};

/// The data manager as the application of a node with two processors sees it; it runs on the
/// companion. It searches the cache itself, and queues its accesses for the manager, which updates
/// the LRU list later. It asks the manager to fetch missing records.
class CompanionManager : public DataManager {
 public:
  /// `means` contains the application's own client of the router, and an empty cache. Starts the
  /// process of `manager` on `router`, the companion of `own`, and allocates memory for the queue.
  CompanionManager(DataManagerMeans means, CacheManager& manager, machine::Processor& router,
                   machine::Processor& own);
  void access(Item item) override;

 private:
  struct Order {
    /// Record to fetch; if absent, the order only announces that accesses are queued.
    std::optional<std::size_t> record;
    static constexpr std::uint64_t bytes() { return 4; }
  };
  [[noreturn]] void run_manager();
  void obey(Order order);
  void note_first();
  void handle_request(const network::Message& message, const DataRequest& request) override;
  void handle_reply(const DataReply& reply) override;

  CacheManager& manager_;
  Cycles queue_step_;
  occam::Channel<Order> orders_;
  occam::Channel<occam::Signal> fetched_;
  std::deque<std::size_t> noted_;  // queue of accesses to records, in the shared memory
  bool is_asleep_ = false;         // true while the manager waits for a message or an order
};

}  // namespace shared_memory

#pragma once
// A data manager with a cache, and its variant for a node of two processors on one memory (thesis,
// 6.2). In such a node, the manager is a process on the processor with the links. It serves other
// processors immediately while the application computes on the companion.
#include <deque>

#include "simulator/shared_memory/data_manager.hpp"

namespace shared_memory {

class CacheManager : public DataManager {
 public:
  using DataManager::DataManager;

  // Implements figure 5.21.
  void access(Item item) override;

  virtual std::size_t record_of(Item item) const = 0;
  /// True if the record is in local memory but not in the cache.
  virtual bool is_resident(std::size_t /*record*/) const { return false; }
  bool holds(std::size_t record) const { return is_resident(record) || cache_.holds(record); }
  /// Requests a record that is not in local memory; returns when it has arrived.
  virtual void ask(std::size_t record) = 0;
  /// Moves a record that was accessed to the top of the cache's LRU list.
  void note_access(std::size_t record) { touch(record); }
  void serve_one(network::Message message) { take(std::move(message)); }
};

/// The application's interface to the manager in a node of two processors; it runs on the
/// companion. Searches the cache itself and queues its accesses, so that the manager can update the
/// LRU list. Requests missing records from the manager.
class CompanionManager : public DataManager {
 public:
  /// `means` contains the application's own client of the router, and an empty cache. Starts the
  /// process of `manager` on `router`, the companion of `own`, and allocates the queue.
  CompanionManager(DataManagerMeans means, CacheManager& manager, machine::Processor& router,
                   machine::Processor& own);
  void access(Item item) override;

 private:
  struct Order {
    std::optional<std::size_t> record;  ///< the record to fetch; if absent, accesses are queued
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
  std::deque<std::size_t> noted_;  // queue of accesses, in the shared memory
  bool is_asleep_ = false;         // the manager is waiting for a message or an order
};

}  // namespace shared_memory

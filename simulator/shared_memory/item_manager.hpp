#pragma once
// The managers of section 5.1.2.3: items fetched one by one from the caches of those on the way to
// the coordinator, and at last from its disk.
#include <optional>

#include "simulator/shared_memory/data_manager.hpp"
#include "simulator/shared_memory/lru_cache.hpp"

namespace shared_memory {

/// DM: its cache serves the local application; others may read it, and that changes nothing in it.
class ItemManager : public DataManager {
 public:
  struct Choices {
    int coordinator = 0;
    bool in_path = true;        ///< requests are offered to all managers on the way
    bool waiting_queue = true;  ///< a request for what has been asked for waits for its reply: WRQu
  };
  ItemManager(network::Client& client, const network::Routing& routing, const DataCosts& costs,
              const Catalogue& catalogue, LruCache cache, const Choices& choices)
      : DataManager(client, routing, costs),
        catalogue_(catalogue),
        cache_(std::move(cache)),
        choices_(choices) {}

  void access(Item item) override;
  const LruCache& cache() const { return cache_; }

 private:
  struct Waiting {
    network::Address who;
    int links;
  };
  void handle_request(const network::Message& message, const DataRequest& request) override;
  void handle_reply(const DataReply& reply) override;

  const Catalogue& catalogue_;
  LruCache cache_;
  const Choices choices_;
  std::optional<std::size_t> asked_;
  std::vector<Waiting> waiting_;  // WRQu of the record that is asked for
};

/// The host's disk: the coordinator asks it for a record over the host link and waits.
class Disk {
 public:
  explicit Disk(const machine::Model& model) : seek_{model.disk.seek}, rate_{model.disk.rate} {}
  /// Blocks the process until the record is there.
  void read(std::uint64_t bytes);

 private:
  Seconds seek_;
  double rate_;  // bytes/s
};

/// DMS, on the coordinator: its cache serves the others; the local application may read it. What is
/// not there it reads from the disk, and serves nobody else meanwhile.
class ItemServer : public DataManager {
 public:
  ItemServer(network::Client& client, const network::Routing& routing, const DataCosts& costs,
             const Catalogue& catalogue, LruCache cache, const machine::Model& model)
      : DataManager(client, routing, costs),
        catalogue_(catalogue),
        cache_(std::move(cache)),
        disk_(model) {}

  void access(Item item) override;

 private:
  void handle_request(const network::Message& message, const DataRequest& request) override;
  void handle_reply(const DataReply& reply) override;

  const Catalogue& catalogue_;
  LruCache cache_;
  Disk disk_;
};

}  // namespace shared_memory

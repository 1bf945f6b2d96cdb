#pragma once
// The managers of section 5.1.2.3: items fetched one by one from the caches of those on the way to
// the coordinator, and at last from its disk.
#include <optional>

#include "simulator/shared_memory/data_manager.hpp"
#include "simulator/shared_memory/disk.hpp"
#include "simulator/shared_memory/lru_cache.hpp"

namespace shared_memory {

// DM: its cache serves the local application; others may read it, and that changes nothing in it.
class ItemManager : public DataManager {
 public:
  // Whom the network asks on the way (in_path), and whether who asks for what this one has asked
  // for already is kept waiting for that reply (WRQu).
  struct Choices {
    int coordinator = 0;
    bool in_path = true, waiting_queue = true;
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
  void handle_request(const network::Message& message, const DataMessage& request) override;
  void handle_reply(const DataMessage& reply) override;

  const Catalogue& catalogue_;
  LruCache cache_;
  const Choices choices_;
  std::optional<std::size_t> asked_;
  std::vector<Waiting> waiting_;  // WRQu of what is asked
};

// DMS, on the coordinator: its cache serves the others; the local application may read it. What is
// not there it reads from the disk, and serves nobody else meanwhile.
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
  void handle_request(const network::Message& message, const DataMessage& request) override;
  void handle_reply(const DataMessage& reply) override;

  const Catalogue& catalogue_;
  LruCache cache_;
  Disk disk_;
};

}  // namespace shared_memory

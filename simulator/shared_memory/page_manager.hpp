#pragma once
// Badouel's scheme (5.1.2.1): all items lie in pages of a fixed size, spread over the processors'
// resident blocks, one address space. A manager that misses an item fetches its whole page from the
// processor that holds it.
#include "simulator/shared_memory/data_manager.hpp"
#include "simulator/shared_memory/lru_cache.hpp"

namespace shared_memory {

/// Where the pages are.
struct Pages {
  Pages(const Catalogue& catalogue, int items_of_page, int processors);
  std::size_t page_of(Item item) const;
  int owner(std::size_t page) const;
  std::uint64_t resident_bytes(int processor) const;

  const Catalogue& catalogue;
  std::size_t items_of_page, count;  ///< items in a page; pages
  std::uint64_t bytes;               ///< of each page: as many of the largest items
  int processors;
};

class PageManager : public DataManager {
 public:
  /// `cache` is one of pages.
  PageManager(network::Client& client, const network::Routing& routing, const DataCosts& costs,
              const Pages& pages, LruCache cache)
      : DataManager(client, routing, costs), pages_(pages), cache_(std::move(cache)) {}

  void access(Item item) override;

 private:
  void handle_request(const network::Message& message, const DataRequest& request) override;
  void handle_reply(const DataReply& reply) override;

  const Pages pages_;
  LruCache cache_;
};

}  // namespace shared_memory

#pragma once
// Data managers for the processors of a network, with two schemes of distributing data:
// - items: an item is fetched from a cache on the route to the coordinator or, if none has it, from
//   the coordinator's disk (thesis, 5.1.2.3);
// - pages: all items lie in pages of fixed size in a common address space. Each processor owns a
//   block of pages, which stays in its memory, and other processors fetch pages from it (Badouel;
//   thesis, 5.1.2.1).
#include <memory>

#include "simulator/observe/control_panel.hpp"
#include "simulator/shared_memory/cache_manager.hpp"

namespace shared_memory {

enum class Scheme : std::uint8_t { items, pages };

struct DataParams {
  Scheme scheme = Scheme::items;
  std::uint64_t cache_bytes = 0;  ///< cache of each processor, without the pages that it owns
  // Parameters of the scheme `items`:
  int coordinator = 0;
  std::uint64_t server_cache_bytes = 0;  ///< cache of the coordinator
  bool in_path = true;  ///< every processor on the route to the coordinator may answer a request
  /// Enables the queue of requests that wait for the same record (WRQu).
  bool waiting_queue = true;
  // Parameters of the scheme `pages`:
  int page_items = 8;
};

/// Maximum length in bytes of a message's contents. network::Params::longest must be at least as
/// large.
std::uint64_t longest_message(const machine::Model& model, const Catalogue& catalogue,
                              const DataParams& params);

/// Makes the data manager of a processor that holds all data. Accesses find their items at no cost,
/// and the manager makes no requests.
std::unique_ptr<DataManager> make_whole_manager(network::Network& network,
                                                const machine::Model& model, int processor);

class VirtualMemory {
 public:
  /// Allocates caches and owned pages. The manager of a processor uses client number 0.
  /// `companions` gives for each processor the companion that runs its application and uses client
  /// number 1, or null. An empty list means that there are no companions. With the scheme `items`,
  /// the coordinator must not have one. The catalogue must outlive this object.
  ///
  /// Throws base::BadInput if a cache is smaller than a record or larger than the free memory, if
  /// there is no processor with the coordinator's number, or if a page would have no items.
  VirtualMemory(machine::Machine& machine, network::Network& network, const Catalogue& catalogue,
                const DataParams& params, int first = 0,
                const std::vector<machine::Processor*>& companions = {});

  /// The manager that the application of a processor must call.
  DataManager& manager(int processor) {
    auto& companion = companions_.at(processor);
    return companion ? *companion : *managers_.at(processor);
  }
  const DataManager& manager(int processor) const {
    const auto& companion = companions_.at(processor);
    return companion ? *companion : *managers_.at(processor);
  }
  DataUse use() const;  ///< sum over all managers
  int processors() const { return static_cast<int>(managers_.size()); }

 private:
  // By processor; an entry may be null.
  std::vector<std::unique_ptr<DataManager>> managers_, companions_;
};

/// Adds counts of accesses and fill levels of caches to a live view.
void show(observe::ControlPanel& view, const VirtualMemory& memory);

}  // namespace shared_memory

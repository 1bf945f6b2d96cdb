#pragma once
// Data managers of a network's processors, with two schemes for distributing data:
// - items: an item is fetched from a cache on the route to the coordinator, or otherwise from the
//   coordinator's disk (5.1.2.3);
// - pages: pages of fixed size hold all items. Each processor owns a resident block of pages of a
//   common address space, and others fetch them from it (Badouel, 5.1.2.1).
#include <memory>

#include "simulator/observe/control_panel.hpp"
#include "simulator/shared_memory/cache_manager.hpp"

namespace shared_memory {

enum class Scheme : std::uint8_t { items, pages };

struct DataParams {
  Scheme scheme = Scheme::items;
  std::uint64_t cache_bytes = 0;  ///< each processor's cache, without resident pages
  // Parameters for the scheme `items`:
  int coordinator = 0;
  std::uint64_t server_cache_bytes = 0;  ///< cache of the coordinator
  bool in_path = true;                   ///< requests are offered to all processors on the route
  bool waiting_queue = true;             ///< enables the waiting queue for requests (WRQu)
  // Parameters for the scheme `pages`:
  int page_items = 8;
};

/// Maximum length of a message's contents in bytes. network::Params::longest must be at least this.
std::uint64_t longest_message(const machine::Model& model, const Catalogue& catalogue,
                              const DataParams& params);

/// Makes the manager of a processor that holds all data. Accesses find their items at no cost, and
/// there are no requests.
std::unique_ptr<DataManager> make_whole_manager(network::Network& network,
                                                const machine::Model& model, int processor);

class VirtualMemory {
 public:
  /// Allocates caches and resident blocks. A processor's manager uses client number 0. `companions`
  /// gives, by processor, the companion that runs its application and uses client number 1, or
  /// null. An empty list means no companions; with items, the coordinator must not have one. The
  /// catalogue must outlive this object.
  ///
  /// Throws base::BadInput for a cache smaller than a record or larger than the free memory, a
  /// missing coordinator, or pages without items.
  VirtualMemory(machine::Machine& machine, network::Network& network, const Catalogue& catalogue,
                const DataParams& params, int first = 0,
                const std::vector<machine::Processor*>& companions = {});

  /// The manager to be called by the application of a processor.
  DataManager& manager(int processor) {
    auto& companion = companions_.at(processor);
    return companion ? *companion : *managers_.at(processor);
  }
  const DataManager& manager(int processor) const {
    const auto& companion = companions_.at(processor);
    return companion ? *companion : *managers_.at(processor);
  }
  DataUse use() const;  ///< total over all managers
  int processors() const { return static_cast<int>(managers_.size()); }

 private:
  std::vector<std::unique_ptr<DataManager>> managers_, companions_;  // by processor; may be null
};

/// Adds counts of accesses and fill levels of caches to the view. The processors have the ids
/// `first`, `first` + 1, ... in the machine.
void show(observe::ControlPanel& view, const VirtualMemory& memory, int first = 0);

}  // namespace shared_memory

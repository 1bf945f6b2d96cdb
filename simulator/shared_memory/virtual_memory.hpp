#pragma once
// Data managers of a network's processors, in two schemes:
// - items are fetched one by one from the caches on the way to the coordinator, or at last from its
//   disk (5.1.2.3);
// - pages of fixed size hold all items. They are spread over the resident blocks of the processors,
//   in one address space, and fetched from their owners (Badouel, 5.1.2.1).
#include <memory>

#include "simulator/observe/control_panel.hpp"
#include "simulator/shared_memory/cache_manager.hpp"

namespace shared_memory {

enum class Scheme : std::uint8_t { items, pages };

struct DataParams {
  Scheme scheme = Scheme::items;
  std::uint64_t cache_bytes = 0;  ///< each processor's cache; pages: beside its resident block
  // Items only:
  int coordinator = 0;
  std::uint64_t server_cache_bytes = 0;  ///< the coordinator's cache
  bool in_path = true;                   ///< processors on the way are offered the requests
  bool waiting_queue = true;             ///< WRQu
  // Pages only:
  int page_items = 8;
};

/// Bytes of the longest message's contents: a lower bound for network::Params::longest.
std::uint64_t longest_message(const machine::Model& model, const Catalogue& catalogue,
                              const DataParams& params);

/// Manager of a processor that holds all data: each access finds its item at no cost, and there are
/// no requests.
std::unique_ptr<DataManager> make_whole_manager(network::Network& network,
                                                const machine::Model& model, int processor);

class VirtualMemory {
 public:
  /// Allocates caches and resident blocks. A processor's manager uses its client number 0.
  /// `companions`: by processor, the companion that runs its application and has client number 1 to
  /// itself, or null; empty: none. With items, the coordinator has none. The catalogue must outlive
  /// it. Throws base::BadInput for a cache below a record's size or above the memory left, a
  /// missing coordinator, or pages without items.
  VirtualMemory(machine::Machine& machine, network::Network& network, const Catalogue& catalogue,
                const DataParams& params, int first = 0,
                const std::vector<machine::Processor*>& companions = {});

  /// The interface for the application of a processor.
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
  std::vector<std::unique_ptr<DataManager>> managers_, companions_;  // by processor, or null
};

/// Adds the memory's counts and cache fill to the view. Its processors have the ids `first`,
/// `first` + 1, ... in the machine.
void show(observe::ControlPanel& view, const VirtualMemory& memory, int first = 0);

}  // namespace shared_memory

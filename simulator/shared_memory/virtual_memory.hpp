#pragma once
// The data managers of a network's processors, one each, in two schemes:
// - items are fetched one by one from the caches of those on the way to the coordinator, and at
// last
//   from its disk (5.1.2.3);
// - pages of a fixed size, which hold all items, are spread over the processors' resident blocks,
//   one address space, and fetched from the processor that holds them (Badouel, 5.1.2.1).
#include <memory>

#include "simulator/observe/spectator.hpp"
#include "simulator/shared_memory/cache_manager.hpp"

namespace shared_memory {

enum class Scheme : std::uint8_t { items, pages };

struct DataParams {
  Scheme scheme = Scheme::items;
  std::uint64_t cache_bytes = 0;  ///< each processor's cache; pages: beside its resident block
  // With items:
  int coordinator = 0;
  std::uint64_t server_cache_bytes = 0;  ///< the coordinator's cache
  bool in_path = true;                   ///< requests are offered to all on the way
  bool waiting_queue = true;             ///< WRQu
  // With pages:
  int page_items = 8;
};

/// Bytes of the longest message's contents: network::Params::longest must be as much.
std::uint64_t longest_message(const machine::Model& model, const Catalogue& catalogue,
                              const DataParams& params);

/// The manager of a processor that holds all data: every access finds its item at no cost, and
/// nobody asks for one.
std::unique_ptr<DataManager> make_whole_manager(network::Network& network,
                                                const machine::Model& model, int processor);

class VirtualMemory {
 public:
  /// Allocates caches and resident blocks on the processors. The manager of a processor uses its
  /// client number 0. Throws base::BadInput for a cache smaller than a record or larger than the
  /// memory that is left, a coordinator that is not there and pages without items. The catalogue
  /// outlives it. `companions`: by processor the companion that its application is on, which has
  /// client number 1 to itself, or null; empty: there are none. Not the coordinator's, with items.
  VirtualMemory(machine::Machine& machine, network::Network& network, const Catalogue& catalogue,
                const DataParams& params, int first = 0,
                const std::vector<machine::Processor*>& companions = {});

  /// What the application of a processor calls.
  DataManager& manager(int processor) {
    auto& companion = companions_.at(processor);
    return companion ? *companion : *managers_.at(processor);
  }
  const DataManager& manager(int processor) const {
    const auto& companion = companions_.at(processor);
    return companion ? *companion : *managers_.at(processor);
  }
  DataUse use() const;  ///< the sum of all
  int processors() const { return static_cast<int>(managers_.size()); }

 private:
  std::vector<std::unique_ptr<DataManager>> managers_, companions_;  // none, or by processor
};

/// Adds to the view what it has done and what caches hold. Its processors have the ids `first`,
/// `first` + 1, ... in the machine.
void show(observe::View& view, const VirtualMemory& memory, int first = 0);

}  // namespace shared_memory

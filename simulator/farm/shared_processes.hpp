#pragma once
// The processes of a farm over routers, one on each processor: a coordinator, and workers that read
// the scene through their data managers.
#include "simulator/farm/coordination.hpp"
#include "simulator/shared_memory/scene_items.hpp"

namespace farm {

/// The second level of the address of both, and what they say to each other.
constexpr int FARM_PROCESS = shared_memory::FIRST_FREE_PROCESS;
struct FarmMessage : network::Contents {
  explicit FarmMessage(std::variant<Stop, renderer::Area, renderer::Block> content)
      : content(std::move(content)) {}
  std::variant<Stop, renderer::Area, renderer::Block> content;
};

/// Blocks that a worker has: one in hand, one ahead.
constexpr int BLOCKS_OF_WORKER = 2;

struct CoordinatorSetup {
  std::vector<renderer::Area> blocks;
  int workers = 0;               ///< processors 1 to this
  machine::OperationCosts cost;  ///< of what is done with the blocks that come back
};
/// Hands out the blocks, adds what comes back to `samples`, and serves data at any time between. (A
/// process without work waits for messages here; it does not look every idle_period.)
void coordinate(const CoordinatorSetup& setup, shared_memory::DataManager& manager,
                renderer::Samples& samples, Progress& progress);

struct WorkerSetup {
  const renderer::Scene& scene;
  const renderer::Params& image;
  const shared_memory::SceneItems& items;
  machine::OperationCosts cost;  ///< of a block
  std::uint32_t pixel_bytes = 0;
  machine::Cycles charged{};  ///< for all blocks of all workers
};
/// Renders the blocks that come, until it is told to stop.
void work(WorkerSetup& setup, shared_memory::DataManager& manager);

/// Bytes of a block that comes back.
std::uint64_t block_bytes(std::uint32_t pixel_bytes, const renderer::Area& area);

}  // namespace farm

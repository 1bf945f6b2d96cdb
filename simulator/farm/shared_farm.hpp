#pragma once
// The farm of blocks of pixels on processors that hold a part of the scene each: everything goes
// over routers, and the scene is read through data managers (5.1.2). Processor 0 coordinates, shows
// the image and serves data; it is joined to the root of the workers' topology, processors 1 to n.
#include "simulator/farm/farm.hpp"
#include "simulator/shared_memory/virtual_memory.hpp"

namespace farm {

/// What the data managers do; their caches follow from the percentages.
struct SharedParams : shared_memory::DataParams {
  /// Each worker's cache in percent of the scene's bytes, up to 100; 0: every worker holds the
  /// scene, which is run_farm. With pages, the resident block is added to it.
  double cache_percent = 0;
  double server_cache_percent = 100;  ///< the coordinator's cache, with items
  network::Method method = network::Method::green;
};

/// Numbers of a scene's records.
struct SceneSize {
  std::size_t boxes = 0, objects = 0;
};
SceneSize size_of(const renderer::Scene& scene);

struct SharedResult {
  Result farm;
  shared_memory::DataUse data;  ///< sum over all managers
  network::RouterUse routers;
  std::uint64_t cache_bytes = 0;  ///< size of a worker's cache
};

/// Throws base::BadInput naming the field, what was found and what was expected: also for
/// parameters of the farm that mean nothing here.
void check(const machine::Model& model, const SceneSize& scene, const Params& farm,
           const SharedParams& data);
/// The part of it that checks that the farm's task is a block.
void check_task(const Params& farm);

/// Workers have farm.worker_memory; the coordinator, which is display and server too,
/// farm.database_memory. The result has no processors "database" and "display". Throws
/// base::BadInput as `check`, as run_farm and if caches and buffers do not fit the memory; and
/// machine::Fault.
SharedResult run_shared_farm(const machine::Model& model, const topologies::Topology& workers,
                             const renderer::Scene& scene, const Params& farm,
                             const SharedParams& data);

}  // namespace farm

#pragma once
// The farm of blocks of pixels on processors that hold a part of the scene each: everything goes
// over routers, and the scene is read through data managers (5.1.2). Processor 0 coordinates, shows
// the image and serves data; it is joined to the root of the workers' topology, processors 1 to n.
#include "simulator/farm/farm.hpp"
#include "simulator/tracing/data.hpp"

namespace farm {

using tracing::SharedParams;

struct SharedResult {
  Result farm;
  tracing::SharedUse shared;
};

/// Throws base::BadInput naming the field, what was found and what was expected: also for
/// parameters of the farm that mean nothing here.
void check(const machine::Model& model, const tracing::SceneSize& scene, const Params& farm,
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

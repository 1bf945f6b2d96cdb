#pragma once
// Farm of blocks of pixels on processors that each hold a part of the scene. Routers carry all
// messages; data managers read the scene (5.1.2). Processor 0 coordinates, displays and serves
// data. It joins the root of the workers' topology, processors 1 to n.
#include "simulator/farm/farm.hpp"
#include "simulator/ray_tracing/data.hpp"

namespace farm {

using ray_tracing::SharedParams;

struct SharedResult {
  Result farm;
  ray_tracing::SharedUse shared;
};

/// Throws base::BadInput naming the field, what was found and what was expected. Refuses farm
/// parameters that have no meaning here.
void check(const machine::Model& model, const ray_tracing::SceneSize& scene, const Params& farm,
           const SharedParams& data);
/// Checks only that the farm's task is a block.
void check_task(const Params& farm);

/// Workers have farm.worker_memory; the coordinator, also display and server, has
/// farm.database_memory. The result has no processors "database" and "display". Throws
/// base::BadInput as `check` and run_farm do, or if caches and buffers exceed the memory; and
/// machine::Fault.
SharedResult run_shared_farm(const machine::Model& model, const topologies::Topology& workers,
                             const renderer::Scene& scene, const Params& farm,
                             const SharedParams& data);

}  // namespace farm

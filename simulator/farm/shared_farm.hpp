#pragma once
// A farm that renders blocks of pixels while the scene is distributed over the processors. Routers
// carry all messages, and data managers fetch scene data (thesis, 5.1.2). Processor 0 coordinates,
// displays and serves data; it is linked to the root of the workers' topology. The workers are
// processors 1 to n.
#include "simulator/farm/farm.hpp"
#include "simulator/ray_tracing/data.hpp"

namespace farm {

using ray_tracing::SharedParams;

struct SharedResult {
  Result farm;
  ray_tracing::SharedUse shared;
};

/// Throws base::BadInput that names the field, the value found and the values expected. Also
/// refuses parameters of the ordinary farm that have no meaning here.
void check(const machine::Model& model, const ray_tracing::SceneSize& scene, const Params& farm,
           const SharedParams& data);
/// Throws base::BadInput if the tasks are single rays instead of blocks of pixels. Checks nothing
/// else.
void check_task(const Params& farm);

/// Runs the farm. Each worker has farm.worker_memory bytes; processor 0 has farm.database_memory.
/// The result has no processors "database" and "display". Throws base::BadInput if check() or
/// run_farm() would, or if caches and buffers exceed the memory. Also throws machine::Fault.
SharedResult run_shared_farm(const Setup& setup, const renderer::Scene& scene, const Params& farm,
                             const SharedParams& data);

}  // namespace farm

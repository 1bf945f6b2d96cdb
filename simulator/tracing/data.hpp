#pragma once
// Workers that hold a part of the scene each and read the rest through data managers (5.1.2):
// [data], and what that took.
#include "simulator/network/network.hpp"
#include "simulator/shared_memory/virtual_memory.hpp"
#include "simulator/tracing/scene.hpp"

namespace tracing {

/// What the data managers do; their caches follow from the percentages.
struct SharedParams : shared_memory::DataParams {
  /// Each worker's cache in percent of the scene's bytes, up to 100; 0: every worker holds the
  /// scene, there are no data managers. With pages, the resident block is added to it.
  double cache_percent = 0;
  double server_cache_percent = 100;  ///< the coordinator's cache, with items
  network::Method method = network::Method::green;
};
/// data.cache_percent and the others of [data].
base::Fields<SharedParams> data_fields();

/// Throws base::BadInput naming the field, what was found and what was expected: also for caches of
/// 0 %.
void check_data(const machine::Model& model, const SceneSize& scene, const SharedParams& data);
/// The caches in bytes.
shared_memory::DataParams make_data_params(const machine::Model& model, const SceneSize& scene,
                                           const SharedParams& data);

/// What sharing the scene's data took.
struct SharedUse {
  shared_memory::DataUse data;  ///< sum over all managers
  network::RouterUse routers;
  std::uint64_t cache_bytes = 0;  ///< size of a worker's cache
  double workers_s = 0;           ///< the time of a run, once for each worker
};

/// What a run shows of it in its table.
struct DataFigures {
  bool is_given = false;         ///< a key of [data]
  std::optional<SharedUse> use;  ///< where the workers share the scene's data
};
/// Missing where no key of [data] is given, and empty where nothing is shared.
base::Columns<DataFigures> data_columns();

}  // namespace tracing

#pragma once
// Distributed scene data. Each worker holds part of the scene and reads the rest through data
// managers (5.1.2). This file has the parameters of [data] and the statistics.
#include "simulator/network/network.hpp"
#include "simulator/ray_tracing/scene.hpp"
#include "simulator/shared_memory/virtual_memory.hpp"

namespace ray_tracing {

/// Parameters of the data managers. The percentages determine the cache sizes.
struct SharedParams : shared_memory::DataParams {
  /// Cache size of each worker in percent of the scene's bytes, up to 100. With 0, every worker
  /// holds the whole scene and there are no data managers. With pages, the resident block comes in
  /// addition.
  double cache_percent = 0;
  double server_cache_percent = 100;  ///< cache of the coordinator; only with items
  network::Method method = network::Method::green;
};
/// The fields of [data], including data.cache_percent.
base::Fields<SharedParams> data_fields();

/// Throws base::BadInput with the field, the value found and the values expected. Also refuses
/// caches of 0 %.
void check_data(const machine::Model& model, const SceneSize& scene, const SharedParams& data);
/// The parameters with cache sizes in bytes.
shared_memory::DataParams make_data_params(const machine::Model& model, const SceneSize& scene,
                                           const SharedParams& data);

/// Statistics of distributed scene data.
struct SharedUse {
  shared_memory::DataUse data;  ///< total over all managers
  network::RouterUse routers;
  std::uint64_t cache_bytes = 0;  ///< cache size of a worker
  double workers_s = 0;           ///< duration of the run multiplied by the number of workers
};

/// Input for the columns on distributed data.
struct DataFigures {
  bool is_given = false;         ///< true if any key of [data] is present
  std::optional<SharedUse> use;  ///< set if the scene is distributed
};
/// Columns that are absent without keys of [data], and empty if the scene is not distributed.
base::Columns<DataFigures> data_columns();

}  // namespace ray_tracing

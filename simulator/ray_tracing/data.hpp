#pragma once
// Distributed scene data. Each worker holds a part of the scene, and reads the rest through data
// managers (thesis, 5.1.2). Defines the parameters of the section [data], and statistics.
#include "simulator/network/network.hpp"
#include "simulator/ray_tracing/scene.hpp"
#include "simulator/shared_memory/virtual_memory.hpp"

namespace ray_tracing {

/// Parameters of the data managers. The percentages determine the cache sizes in DataParams.
struct SharedParams : shared_memory::DataParams {
  /// Cache size of each worker in percent of the scene's bytes, up to 100. With 0, every worker
  /// holds the whole scene and there are no data managers. With the scheme `pages`, a worker also
  /// holds the pages that it owns.
  double cache_percent = 0;
  /// Cache size of the coordinator in percent; only with the scheme `items`.
  double server_cache_percent = 100;
  network::Method method = network::Method::green;
};
/// The fields of the section [data], including data.cache_percent.
base::Fields<SharedParams> data_fields();

/// Throws base::BadInput that names the field, the value found and the values expected. Refuses
/// caches of 0 %.
void check_data(const machine::Model& model, const SceneSize& scene, const SharedParams& data);
/// Returns the parameters with the cache sizes converted from percent to bytes.
shared_memory::DataParams make_data_params(const machine::Model& model, const SceneSize& scene,
                                           const SharedParams& data);

/// Statistics of distributed scene data.
struct SharedUse {
  shared_memory::DataUse data;  ///< sum over all data managers
  network::RouterUse routers;
  std::uint64_t cache_bytes = 0;  ///< cache size of one worker
  double workers_s = 0;           ///< duration of the run in s, multiplied by the number of workers
};

/// The input for the columns about distributed scenes.
struct DataFigures {
  bool is_given = false;         ///< true if the experiment contains any key of [data]
  std::optional<SharedUse> use;  ///< only if the scene is distributed
};
/// Columns about distributed scenes. They are absent if the experiment has no key of [data], and
/// empty if the scene is not distributed.
base::Columns<DataFigures> data_columns();

}  // namespace ray_tracing

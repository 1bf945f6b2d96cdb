#pragma once
// Distributed scene data: each worker holds a part of the scene and reads the rest through data
// managers (5.1.2). Parameters of [data], and statistics.
#include "simulator/network/network.hpp"
#include "simulator/ray_tracing/scene.hpp"
#include "simulator/shared_memory/virtual_memory.hpp"

namespace ray_tracing {

/// Parameters of the data managers; their cache sizes follow from the percentages.
struct SharedParams : shared_memory::DataParams {
  /// Cache of each worker in percent of the scene's bytes, up to 100. 0: every worker holds the
  /// scene, without data managers. With pages, the resident block comes on top.
  double cache_percent = 0;
  double server_cache_percent = 100;  ///< the coordinator's cache, with items
  network::Method method = network::Method::green;
};
/// data.cache_percent and the other fields of [data].
base::Fields<SharedParams> data_fields();

/// Throws base::BadInput with the field, the value found and the values expected; also for caches
/// of 0 %.
void check_data(const machine::Model& model, const SceneSize& scene, const SharedParams& data);
/// The caches in bytes.
shared_memory::DataParams make_data_params(const machine::Model& model, const SceneSize& scene,
                                           const SharedParams& data);

/// Statistics of sharing the scene's data.
struct SharedUse {
  shared_memory::DataUse data;  ///< sum over all managers
  network::RouterUse routers;
  std::uint64_t cache_bytes = 0;  ///< size of a worker's cache
  double workers_s = 0;           ///< time of the run times the number of workers
};

/// Input of the table's columns on shared data.
struct DataFigures {
  bool is_given = false;         ///< a key of [data] is given
  std::optional<SharedUse> use;  ///< if the workers share the scene's data
};
/// Absent if no key of [data] is given, and empty if nothing is shared.
base::Columns<DataFigures> data_columns();

}  // namespace ray_tracing

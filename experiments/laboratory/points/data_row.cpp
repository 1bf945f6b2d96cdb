#include "experiments/laboratory/points/data_row.hpp"

namespace laboratory {

nlohmann::ordered_json make_data_row(const farm::SharedResult& result) {
  using shared_memory::Level;
  const auto& data = result.data;
  // A share of nothing is 0.
  const auto share = [](double part, double all) { return all > 0 ? part / all : 0; };
  const auto hit = [&](Level level) {
    return share(double(data.found_at(level)), double(data.accesses()));
  };
  const double workers_s = result.farm.topology.processors * result.farm.time_s;
  return {{"cache_bytes", result.cache_bytes},
          {"data_accesses", data.accesses()},
          {"hit_local", hit(Level::local)},
          {"hit_path", hit(Level::path)},
          {"hit_queue", hit(Level::queue)},
          {"hit_server", hit(Level::coordinator)},
          {"hit_disk", hit(Level::disk)},
          {"data_requests", data.requests},
          {"data_request_links", share(double(data.request_links), double(data.requests))},
          {"data_links_saved_path", data.spared_by_path},
          {"data_links_saved_queue", data.spared_by_queue},
          {"data_wait_ms", share(data.waited.value, double(data.requests)) * 1e3},
          {"data_wait_share", share(data.waited.value, workers_s)},
          {"router_messages_max", result.routers.most_held}};
}

nlohmann::ordered_json make_empty_data_row() {
  auto row = make_data_row({});
  for (auto& value : row) value = nullptr;
  return row;
}

}  // namespace laboratory

#include "simulator/ray_tracing/data.hpp"

#include <fmt/format.h>

#include <cmath>

#include "simulator/observe/mean.hpp"
#include "simulator/programs/declare/routers.hpp"

namespace ray_tracing {

namespace {

struct SceneBytes {
  SceneBytes(const machine::Model& model, const SceneSize& scene)
      : box(get_bytes(model, "box")),
        object(get_bytes(model, "object")),
        all(scene.boxes * box + scene.objects * object) {}
  std::uint64_t percent(double share) const {
    return static_cast<std::uint64_t>(std::llround(share / 100 * static_cast<double>(all)));
  }
  std::uint64_t box, object, all;
};

void check_percent(const char* key, double percent, const SceneBytes& scene,
                   std::uint64_t largest) {
  if (!(percent > 0 && percent <= 100))
    base::refuse(key, "found {}, expected more than 0 and at most 100", percent);
  if (const auto bytes = scene.percent(percent); bytes < largest)
    base::refuse(key,
                 "found a cache of {2} bytes ({0} % of a scene of {1} bytes), expected at least "
                 "{3} bytes, its largest record",
                 percent, scene.all, bytes, largest);
}

base::Columns<SharedUse> shared_columns() {
  using U = SharedUse;
  using base::column;
  const auto wait_share = [](const U& u) {
    return observe::eval_mean(u.data.waited.value, u.workers_s);
  };
  return base::join(
      base::Columns<U>{column("cache_bytes", &U::cache_bytes, "size of a worker's cache")},
      {base::lift_columns<U>(shared_memory::data_columns(), &U::data),
       {column<U>("data_wait_share", wait_share,
                  "share of the workers' time spent waiting for data"),
        column<U>(
            "most_held", [](const U& u) { return u.routers.most_held; },
            "largest number of messages held by one router")}});
}

}  // namespace

base::Fields<SharedParams> data_fields() {
  using D = base::Declare<SharedParams>;
  static const base::Names<shared_memory::Scheme> SCHEMES = {
      {"items", shared_memory::Scheme::items}, {"pages", shared_memory::Scheme::pages}};
  auto methods = programs::METHODS;
  std::erase(methods, std::pair(std::string("naive"), network::Method::naive));
  return {
      D::number("data.cache_percent", &SharedParams::cache_percent, 0, 100, "%",
                "cache of a worker, as a share of the scene's bytes; 0: each worker holds the "
                "whole scene"),
      D::number(
          "data.server_cache_percent", &SharedParams::server_cache_percent, 0, 100, "%",
          "cache of the coordinator, as a share of the scene's bytes, for scheme = \"items\""),
      D::choice("data.scheme", &SharedParams::scheme, SCHEMES,
                "items: caches on the path to the coordinator supply them; pages: spread over the "
                "workers"),
      D::flag("data.in_path", &SharedParams::in_path,
              "true: requests are offered to every processor on the path"),
      D::flag(
          "data.waiting_queue", &SharedParams::waiting_queue,
          "true: a processor that waits for an item forwards it to others that request it (WRQu)"),
      D::whole("data.page_items", &SharedParams::page_items, 1, 1e6, "", "items in a page"),
      D::choice("data.method", &SharedParams::method, methods,
                "how routers avoid deadlock: green, chalmers or acyclic")};
}

void check_data(const machine::Model& model, const SceneSize& size, const SharedParams& data) {
  const SceneBytes scene(model, size);
  if (scene.all == 0)
    base::refuse("scene.source", "found no objects, expected at least one for [data]");
  std::uint64_t largest = size.boxes > 0 ? std::max(scene.box, scene.object) : scene.object;
  if (data.scheme == shared_memory::Scheme::pages)
    largest *= static_cast<std::uint64_t>(data.page_items);
  check_percent("data.cache_percent", data.cache_percent, scene, largest);
  if (data.scheme == shared_memory::Scheme::items)
    check_percent("data.server_cache_percent", data.server_cache_percent, scene, largest);
}

shared_memory::DataParams make_data_params(const machine::Model& model, const SceneSize& size,
                                           const SharedParams& data) {
  const SceneBytes scene(model, size);
  shared_memory::DataParams params = data;
  params.cache_bytes = scene.percent(data.cache_percent);
  params.server_cache_bytes = scene.percent(data.server_cache_percent);
  return params;
}

base::Columns<DataFigures> data_columns() {
  base::Columns<DataFigures> all;
  for (const auto& c : shared_columns()) {
    const auto get = [get = c.get](const DataFigures& figures) {
      return figures.use ? get(*figures.use) : std::vector<base::Cell>(1);
    };
    all.push_back({c.name, c.help, get});
  }
  return base::only_if(&DataFigures::is_given, all);
}

}  // namespace ray_tracing

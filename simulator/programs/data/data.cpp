// Random accesses to common data from all over a network, by way of data managers.
#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "simulator/declare/routers.hpp"
#include "simulator/programs/data/data_run.hpp"
#include "simulator/shared_memory/columns.hpp"

namespace programs {

namespace {

enum class Scheme { in_path, no_queue, direct, pages };
const base::Names<Scheme> SCHEMES = {{"in-path", Scheme::in_path},
                                     {"no-queue", Scheme::no_queue},
                                     {"direct", Scheme::direct},
                                     {"pages", Scheme::pages}};
const base::Names<bool> BETWEEN_PASSES = {{"wait", true}, {"go-on", false}};
const base::Names<bool> COORDINATOR_IS = {{"idle", false}, {"working", true}};

struct Params {
  RouterParams routers;
  DataLoad load;  // but for what follows
  double cache_percent = 9, server_cache_percent = 0;
  int coordinator = -1;
  Scheme scheme = Scheme::in_path;
};

std::uint64_t bytes_of_percent(const DataLoad& load, const char* name, double percent) {
  const double items = std::floor(percent / 100 * load.items + 1e-9);
  if (items < 1)
    throw base::BadInput(
        fmt::format("program.{}: found {} % of {} items, expected at least one item", name, percent,
                    load.items));
  return static_cast<std::uint64_t>(items) * load.item_bytes;
}

int find_coordinator(const Setup& setup, const Params& params) {
  const auto& topology = setup.topology;
  if (params.coordinator >= topology.processors)
    throw base::BadInput(
        fmt::format("program.coordinator: found {}, expected a processor of {}: 0 to {}, or -1 for "
                    "its root",
                    params.coordinator, topology.name, topology.processors - 1));
  if (topology.processors < 2)
    throw base::BadInput(
        fmt::format("network: found {}, expected at least two processors: the coordinator makes no "
                    "accesses",
                    topology.name));
  return params.coordinator < 0 ? topology.root : params.coordinator;
}

DataLoad make_load(const Setup& setup, const Params& params) {
  DataLoad load = params.load;
  load.network = network_params(params.routers, 0);
  auto& data = load.data;
  data.scheme =
      params.scheme == Scheme::pages ? shared_memory::Scheme::pages : shared_memory::Scheme::items;
  data.in_path = params.scheme != Scheme::direct;
  data.waiting_queue = params.scheme != Scheme::no_queue;
  data.cache_bytes = bytes_of_percent(load, "cache_percent", params.cache_percent);
  data.server_cache_bytes =
      params.server_cache_percent == 0
          ? data.cache_bytes
          : bytes_of_percent(load, "server_cache_percent", params.server_cache_percent);
  data.coordinator = find_coordinator(setup, params);
  return load;
}

struct Measured : DataPass {
  int number = 0;
};

Outcome<Measured> run(const Setup& setup, const Params& params) {
  const auto passes =
      run_data(setup, routing_of(setup, params.routers.method), make_load(setup, params));
  Outcome<Measured> outcome;
  for (const auto& pass : passes)
    outcome.rows.push_back({pass, static_cast<int>(outcome.rows.size()) + 1});
  return outcome;
}

base::Fields<DataLoad> load_fields() {
  using D = base::Declare<DataLoad>;
  return {D::whole("items", &DataLoad::items, 1, 1e6, "", "number of items"),
          D::whole("item_bytes", &DataLoad::item_bytes, 1, 1e6, "bytes", "size of an item"),
          D::whole("accesses", &DataLoad::accesses, 1, 1e7, "",
                   "accesses of each processor in each pass"),
          D::whole("passes", &DataLoad::passes, 1, 1000, "", "passes, one after the other"),
          D::number("zipf", &DataLoad::zipf, 0, 10, "",
                    "Zipf's exponent: item k is wanted in proportion to 1 / k^zipf; 0: all alike")};
}

base::Fields<Params> make_fields() {
  using D = base::Declare<Params>;
  return base::join(
      base::lift_all<Params>(router_fields(), &Params::routers),
      {base::lift_all<Params>(load_fields(), &Params::load),
       {D::number("cache_percent", &Params::cache_percent, 0, 100, "%",
                  "items that a cache has room for"),
        D::number("server_cache_percent", &Params::server_cache_percent, 0, 100, "%",
                  "items that the coordinator's cache has room for; 0: as many as the others"),
        D::whole(
            "page_items", [](Params & p) -> auto& { return p.load.data.page_items; }, 1, 1e6, "",
            "items of a page, where there are pages"),
        D::whole("coordinator", &Params::coordinator, -1, 1e6, "",
                 "a processor; -1: the network's root"),
        D::choice("scheme", &Params::scheme, SCHEMES,
                  "requests are offered to all on the way to the coordinator, without WRQu, go to "
                  "it directly; or there are fixed pages without a coordinator"),
        D::choice(
            "between_passes", [](Params & p) -> auto& { return p.load.together; }, BETWEEN_PASSES,
            "all wait for the last one, or each goes on"),
        D::choice(
            "coordinator_is", [](Params & p) -> auto& { return p.load.coordinator_too; },
            COORDINATOR_IS,
            "working: it makes accesses as the others do, which it always does with pages"),
        seed_field<Params>(
            [](Params & p) -> auto& { return p.load.seed; }, "seed of the accesses")}});
}

// requests_at_coordinator stands behind the requests.
base::Columns<Measured> make_columns() {
  auto data = base::lift_columns<Measured>(shared_memory::data_columns(), &Measured::use);
  data.insert(std::ranges::find(data, "requests", &base::Column<Measured>::name) + 1,
              base::column<Measured>(
                  "requests_at_coordinator", [](const Measured& m) { return m.server_seen; },
                  "requests that came to the coordinator; empty where passes are not waited for"));
  return base::join<base::Column<Measured>>(
      {base::column("pass", &Measured::number, "number of the pass, from 1"),
       base::column<Measured>(
           "time_s", [](const Measured& m) { return m.time_s; },
           "time from the end of the pass before until the last processor has finished"),
       base::column<Measured>(
           "time_mean_s", [](const Measured& m) { return m.mean_s; },
           "time that a processor was at it, on average")},
      {std::move(data)});
}

}  // namespace

Program make_data() {
  return make_program<Params, Measured>(
      {.name = "data",
       .help = "every processor but the coordinator makes random accesses to common items",
       .uses = {.network = true, .routes = true},
       .fields = make_fields(),
       .columns = make_columns(),
       .parts = {"pass"},
       .run = &run});
}

}  // namespace programs

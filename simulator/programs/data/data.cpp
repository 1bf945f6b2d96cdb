#include "simulator/programs/data/data.hpp"

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "simulator/declare/routers.hpp"

namespace programs {

namespace {

using shared_memory::Level;

std::uint64_t bytes_of_percent(const Setup& setup, const char* name) {
  const double all = setup["items"] * setup["item_bytes"];
  const double items = std::floor(setup[name] / 100 * setup["items"] + 1e-9);
  if (items < 1)
    throw base::BadInput(
        fmt::format("program.{}: found {} % of {} items, expected at least one item", name,
                    setup[name], setup["items"]));
  return static_cast<std::uint64_t>(items * (all / setup["items"]));
}

DataLoad make_load(const Setup& setup) {
  DataLoad load;
  load.network = network_params(setup, 0);
  const std::string scheme = setup.choice("scheme");
  auto& data = load.data;
  data.scheme = scheme == "pages" ? shared_memory::Scheme::pages : shared_memory::Scheme::items;
  data.in_path = scheme != "direct";
  data.waiting_queue = scheme != "no-queue";
  data.page_items = static_cast<int>(setup.whole("page_items"));
  data.cache_bytes = bytes_of_percent(setup, "cache_percent");
  data.server_cache_bytes = setup["server_cache_percent"] == 0
                                ? data.cache_bytes
                                : bytes_of_percent(setup, "server_cache_percent");
  const auto coordinator = setup.whole("coordinator");
  if (coordinator >= setup.topology.processors)
    throw base::BadInput(
        fmt::format("program.coordinator: found {}, expected a processor of {}: 0 to {}, or -1 for "
                    "its root",
                    coordinator, setup.topology.name, setup.topology.processors - 1));
  data.coordinator = coordinator < 0 ? setup.topology.root : static_cast<int>(coordinator);
  if (setup.topology.processors < 2)
    throw base::BadInput(
        fmt::format("network: found {}, expected at least two processors: the coordinator makes no "
                    "accesses",
                    setup.topology.name));
  load.items = static_cast<int>(setup.whole("items"));
  load.item_bytes = static_cast<std::uint64_t>(setup.whole("item_bytes"));
  load.accesses = static_cast<int>(setup.whole("accesses"));
  load.passes = static_cast<int>(setup.whole("passes"));
  load.zipf = setup["zipf"];
  load.together = setup.choice("between_passes") == "wait";
  load.coordinator_too = setup.choice("coordinator_is") == "working";
  load.seed = static_cast<std::uint64_t>(setup.whole("seed"));
  return load;
}

Row make_row(int number, const DataPass& pass) {
  const auto& use = pass.use;
  const auto of = [](std::uint64_t part, std::uint64_t whole) {
    return static_cast<double>(part) / std::max(1.0, static_cast<double>(whole));
  };
  const auto share = [&](Level level) { return of(use.found_at(level), use.accesses()); };
  return {{"pass", number},
          {"time_s", pass.time_s},
          {"time_mean_s", pass.mean_s},
          {"accesses_made", static_cast<double>(use.accesses())},
          {"local", share(Level::local)},
          {"on_path", share(Level::path)},
          {"by_queue", share(Level::queue)},
          {"at_coordinator", share(Level::coordinator)},
          {"on_disk", share(Level::disk)},
          {"requests", static_cast<double>(use.requests)},
          {"requests_at_coordinator", pass.server_seen},
          {"links_per_request", of(use.request_links, use.requests)},
          {"spared_by_path", static_cast<double>(use.spared_by_path)},
          {"spared_by_queue", static_cast<double>(use.spared_by_queue)},
          {"wait_per_request_s", use.waited.value / std::max(1.0, double(use.requests))}};
}

Rows run(const Setup& setup) {
  const DataLoad load = make_load(setup);
  Rows rows;
  for (const auto& pass : run_data(setup.model, routing_of(setup), load, setup.watch))
    rows.rows.push_back(make_row(static_cast<int>(rows.rows.size()) + 1, pass));
  return rows;
}

}  // namespace

Pattern make_data() {
  return {.name = "data",
          .help =
              "every processor but the coordinator makes random accesses to common items by way of "
              "its data manager: time_s of each pass (time_mean_s: that a processor was at it, on "
              "average), and where items were: shares local, on_path, "
              "by_queue, at_coordinator, on_disk",
          .uses_topology = true,
          .parameters = router_parameters(
              {{"items", 1000, 1, 1e6, true, "that there are"},
               {"item_bytes", 64, 1, 1e6, true, "size of an item"},
               {"accesses", 1000, 1, 1e7, true, "of each processor in each pass"},
               {"passes", 1, 1, 1000, true, "one after the other"},
               {"zipf", 0, 0, 10, false,
                "Zipf's exponent: item k is wanted in proportion to 1 / k^zipf; 0: all alike"},
               {"cache_percent", 9, 0, 100, false, "of the items, that a cache has room for"},
               {"server_cache_percent", 0, 0, 100, false,
                "the same of the coordinator's cache; 0: as the others"},
               {"page_items", 8, 1, 1e6, true, "items of a page, where there are pages"},
               {"coordinator", -1, -1, 1e6, true, "a processor; -1: the network's root"},
               make_choice("scheme", {"in-path", "no-queue", "direct", "pages"},
                           "requests are offered to all on the way to the coordinator, "
                           "without WRQu, go to it directly; or fixed pages without one"),
               make_choice("between_passes", {"wait", "go-on"},
                           "all wait for the last one, or each goes on"),
               make_choice(
                   "coordinator_is", {"idle", "working"},
                   "working: it makes accesses as the others do, which it always does with pages"),
               {"seed", 1, 0, 1e15, true, "of the accesses"}}),
          .run = &run,
          .parts = {"pass"},
          .uses_routes = true};
}

}  // namespace programs

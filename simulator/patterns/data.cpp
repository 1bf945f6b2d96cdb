#include "simulator/patterns/data.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "simulator/patterns/support.hpp"

namespace patterns {

namespace {

using iirra::DataManager;
using iirra::DataUse;
using iirra::Level;

constexpr int FINISHED = iirra::FIRST_FREE_PROCESS, GO_ON = FINISHED + 1;

// What a processor's manager had counted, and when, at the end of a pass.
struct Mark {
  Seconds start{}, end{};
  DataUse use;
};

class Test {
 public:
  Test(const network::Routing& routing, const DataLoad& load, iirra::VirtualMemory& memory)
      : load_(load),
        routing_(routing),
        memory_(memory),
        marks_(static_cast<std::size_t>(load.passes),
               std::vector<Mark>(static_cast<std::size_t>(routing.processors()))) {}

  // The process of one processor.
  void live(int id) {
    DataManager& data = memory_.manager(id);
    const bool is_coordinator = id == load_.data.coordinator;
    const bool accesses = !is_coordinator || makes_accesses(id);
    std::mt19937_64 random(load_.seed * 1'000'003 + static_cast<std::uint64_t>(id));
    for (auto& pass : marks_) {
      Mark& mark = pass[static_cast<std::size_t>(id)];
      mark.start = now();
      if (accesses && makes_accesses(id)) make_accesses(data, random);
      this_process().sync();
      mark.end = now();
      mark.use = data.use();
      if (load_.together) wait_for_others(data, is_coordinator);
    }
    data.serve_for_ever();
  }

  std::vector<DataPass> finish() const {
    std::vector<DataPass> passes;
    Seconds before{};
    for (std::size_t p = 0; p < marks_.size(); ++p) {
      DataPass& pass = passes.emplace_back();
      Seconds start{INFINITY}, end{};
      for (int id = 0; id < routing_.processors(); ++id) {
        const Mark& mark = marks_[p][static_cast<std::size_t>(id)];
        const DataUse earlier = p > 0 ? marks_[p - 1][static_cast<std::size_t>(id)].use : DataUse{};
        if (id == load_.data.coordinator) pass.server_seen = mark.use.seen - earlier.seen;
        if (!makes_accesses(id)) continue;
        start = std::min(start, mark.start);
        end = std::max(end, mark.end);
        pass.use += mark.use;
        pass.use -= earlier;
      }
      pass.time_s = (end - (load_.together ? start : before)).value;
      before = end;
    }
    return passes;
  }

 private:
  bool makes_accesses(int id) const {
    return id != load_.data.coordinator || load_.coordinator_too ||
           load_.data.scheme == iirra::Scheme::pages;
  }

  void make_accesses(DataManager& data, std::mt19937_64& random) const {
    for (int i = 0; i < load_.accesses; ++i) {
      const double uniform = static_cast<double>(random() >> 11) * 0x1p-53;
      data.access({0, static_cast<int>(uniform * load_.items)});
    }
  }

  void wait_for_others(DataManager& data, bool is_coordinator) const {
    if (!is_coordinator) {
      network::Message finished;
      finished.to = {load_.data.coordinator, FINISHED};
      data.client().send(finished);
      data.serve();
      return;
    }
    for (int others = routing_.processors() - 1; others > 0; --others) data.serve();
    network::Message go_on;
    go_on.to = network::make_global(GO_ON);
    data.client().send(go_on);
  }

  const DataLoad& load_;
  const network::Routing& routing_;
  iirra::VirtualMemory& memory_;
  std::vector<std::vector<Mark>> marks_;  // by pass and processor
};

}  // namespace

std::vector<DataPass> run_data(const machine::Model& model, const network::Routing& routing,
                               const DataLoad& load, observe::Watch* watch) {
  const int n = routing.processors();
  machine::Machine machine(model);
  for (int id = 0; id < n; ++id)
    machine.add_processor(fmt::format("p{}", id), get_bytes(model, "worker_memory"));
  const auto catalogue = iirra::make_catalogue(load.items, load.item_bytes);
  auto params = load.network;
  params.longest = longest_message(model, catalogue, load.data);
  network::Network network(machine, routing, params);
  iirra::VirtualMemory memory(machine, network, catalogue, load.data);
  Test test(network.routing(), load, memory);
  for (int id = 0; id < n; ++id)
    machine.processors()[id]->start("application", Priority::low, [&, id] { test.live(id); });
  observe::Watch none;
  const auto end = observe::run(machine, watch ? *watch : none);
  if (end != machine::End::done)
    throw Unfinished(
        "machine", machine.now(),
        fmt::format("the run was ended at {:.6f} s ({})", machine.now().value, to_string(end)));
  return test.finish();
}

namespace {

std::uint64_t bytes_of_percent(const Setup& setup, const char* name) {
  const double all = setup["items"] * setup["item_bytes"];
  const double items = std::floor(setup[name] / 100 * setup["items"] + 1e-9);
  if (items < 1)
    throw machine::InvalidInput(
        fmt::format("program.{}: found {} % of {} items, expected at least one item", name,
                    setup[name], setup["items"]));
  return static_cast<std::uint64_t>(items * (all / setup["items"]));
}

DataLoad make_load(const Setup& setup) {
  DataLoad load;
  const std::string router = setup.choice("router"), scheme = setup.choice("scheme");
  load.network.method = router == "green"      ? network::Method::green
                        : router == "chalmers" ? network::Method::chalmers
                                               : network::Method::acyclic;
  load.network.buffers = static_cast<std::size_t>(4 * setup.topology.processors + 16);
  auto& data = load.data;
  data.scheme = scheme == "pages" ? iirra::Scheme::pages : iirra::Scheme::items;
  data.in_path = scheme != "direct";
  data.waiting_queue = scheme != "no-queue";
  data.page_items = static_cast<int>(setup.whole("page_items"));
  data.cache_bytes = bytes_of_percent(setup, "cache_percent");
  data.server_cache_bytes = setup["server_cache_percent"] == 0
                                ? data.cache_bytes
                                : bytes_of_percent(setup, "server_cache_percent");
  const auto coordinator = setup.whole("coordinator");
  if (coordinator >= setup.topology.processors)
    throw machine::InvalidInput(
        fmt::format("program.coordinator: found {}, expected a processor of {}: 0 to {}, or -1 for "
                    "its root",
                    coordinator, setup.topology.name, setup.topology.processors - 1));
  data.coordinator = coordinator < 0 ? setup.topology.root : static_cast<int>(coordinator);
  if (setup.topology.processors < 2)
    throw machine::InvalidInput(
        fmt::format("network: found {}, expected at least two processors: the coordinator makes no "
                    "accesses",
                    setup.topology.name));
  load.items = static_cast<int>(setup.whole("items"));
  load.item_bytes = static_cast<std::uint64_t>(setup.whole("item_bytes"));
  load.accesses = static_cast<int>(setup.whole("accesses"));
  load.passes = static_cast<int>(setup.whole("passes"));
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
          {"accesses", static_cast<double>(use.accesses())},
          {"local", share(Level::local)},
          {"on_path", share(Level::path)},
          {"by_queue", share(Level::queue)},
          {"at_coordinator", share(Level::coordinator)},
          {"on_disk", share(Level::disk)},
          {"requests", static_cast<double>(use.requests)},
          {"requests_at_coordinator", static_cast<double>(pass.server_seen)},
          {"links_per_request", of(use.request_links, use.requests)},
          {"spared_by_path", static_cast<double>(use.spared_by_path)},
          {"spared_by_queue", static_cast<double>(use.spared_by_queue)},
          {"wait_per_request_s", use.waited.value / std::max(1.0, double(use.requests))}};
}

Rows run(const Setup& setup) {
  const DataLoad load = make_load(setup);
  Rows rows;
  const auto routing =
      network::make_routing(load.network.method, setup.topology, setup.routes, setup.tree);
  for (const auto& pass : run_data(setup.model, routing, load, setup.watch))
    rows.rows.push_back(make_row(static_cast<int>(rows.rows.size()) + 1, pass));
  return rows;
}

}  // namespace

Pattern make_data() {
  return {
      .name = "data",
      .help =
          "every processor but the coordinator makes random accesses to common items by way of "
          "its data manager: time_s of each pass, and where items were: shares local, on_path, "
          "by_queue, at_coordinator, on_disk",
      .uses_topology = true,
      .parameters = {{"items", 1000, 1, 1e6, true, "that there are"},
                     {"item_bytes", 64, 1, 1e6, true, "size of an item"},
                     {"accesses", 1000, 1, 1e7, true, "of each processor in each pass"},
                     {"passes", 1, 1, 1000, true, "one after the other"},
                     {"cache_percent", 9, 0, 100, false, "of the items, that a cache has room for"},
                     {"server_cache_percent", 0, 0, 100, false,
                      "the same of the coordinator's cache; 0: as the others"},
                     {"page_items", 8, 1, 1e6, true, "items of a page, where there are pages"},
                     {"coordinator", -1, -1, 1e6, true, "a processor; -1: the network's root"},
                     make_choice("scheme", {"in-path", "no-queue", "direct", "pages"},
                                 "requests are offered to all on the way to the coordinator, "
                                 "without WRQu, go to it directly; or fixed pages without one"),
                     make_choice("router", {"green", "chalmers", "acyclic"},
                                 "method of the routers"),
                     make_choice("between_passes", {"wait", "go-on"},
                                 "all wait for the last one, or each goes on"),
                     make_choice("coordinator_is", {"idle", "working"},
                                 "working: it makes accesses as the others do"),
                     {"seed", 1, 0, 1e15, true, "of the accesses"}},
      .run = &run,
      .parts = {"pass"},
      .uses_routes = true};
}

}  // namespace patterns

#include "simulator/programs/data/data.hpp"

#include "base/random.hpp"
#include "simulator/programs/declare/routers.hpp"

namespace programs {

namespace {

using shared_memory::DataManager;
using shared_memory::DataUse;

constexpr int FINISHED = shared_memory::FIRST_FREE_PROCESS, GO_ON = FINISHED + 1;

// Start and end of one pass on one processor, and the counts of its data manager at the end.
struct Mark {
  Seconds start{}, end{};
  DataUse use;
};

class Test {
 public:
  Test(const network::Routing& routing, const DataLoad& load, shared_memory::VirtualMemory& memory)
      : load_(load),
        routing_(routing),
        memory_(memory),
        marks_(static_cast<std::size_t>(load.passes),
               std::vector<Mark>(static_cast<std::size_t>(routing.processors()))) {
    double sum = 0;
    for (int k = 0; k < load.items; ++k) wanted_.push_back(sum += std::pow(k + 1, -load.zipf));
  }

  // Body of the process on processor `id`.
  void live(int id) {
    DataManager& data = memory_.manager(id);
    const bool is_coordinator = id == load_.data.coordinator;
    base::Random random(load_.seed, id);
    for (auto& pass : marks_) {
      Mark& mark = pass[id];
      mark.start = now();
      if (makes_accesses(id)) make_accesses(data, random);
      mark.end = now();
      if (load_.together && is_coordinator) wait_for_others(data);
      mark.use = data.use();
      if (load_.together && is_coordinator) go_on(data);
      if (load_.together && !is_coordinator) report(data);
    }
    data.serve_for_ever();
  }

  std::vector<DataPass> finish() const {
    std::vector<DataPass> passes;
    int who = 0;
    for (int id = 0; id < routing_.processors(); ++id) who += makes_accesses(id) ? 1 : 0;
    for (std::size_t p = 0; p < marks_.size(); ++p) {
      DataPass& pass = passes.emplace_back();
      pass.number = static_cast<int>(p) + 1;
      Seconds start{INFINITY}, end{};
      for (int id = 0; id < routing_.processors(); ++id) {
        const Mark& mark = marks_[p][id];
        const DataUse earlier = p > 0 ? marks_[p - 1][id].use : DataUse{};
        if (id == load_.data.coordinator && load_.together)
          pass.server_seen = mark.use.seen - earlier.seen;
        if (!makes_accesses(id)) continue;
        start = std::min(start, mark.start);
        end = std::max(end, mark.end);
        pass.mean_s += (mark.end - mark.start).value / who;
        pass.use += mark.use;
        pass.use -= earlier;
      }
      pass.time_s = (end - start).value;
    }
    return passes;
  }

 private:
  bool makes_accesses(int id) const {
    return id != load_.data.coordinator || load_.coordinator_too ||
           load_.data.scheme == shared_memory::Scheme::pages;
  }

  void make_accesses(DataManager& data, base::Random& random) const {
    for (int i = 0; i < load_.accesses; ++i) {
      const auto item = std::ranges::upper_bound(wanted_, random.uniform() * wanted_.back());
      data.access({0, std::min(static_cast<int>(item - wanted_.begin()), load_.items - 1)});
    }
  }

  void report(DataManager& data) const {
    data.client().send({.to = {load_.data.coordinator, FINISHED}});
    data.serve();
  }
  void wait_for_others(DataManager& data) const {
    for (int others = routing_.processors() - 1; others > 0; --others) data.serve();
  }
  static void go_on(DataManager& data) { data.client().send({.to = network::make_global(GO_ON)}); }

  const DataLoad& load_;
  const network::Routing& routing_;
  shared_memory::VirtualMemory& memory_;
  std::vector<std::vector<Mark>> marks_;  // by pass, then by processor
  // Sums of the weights of items 0 to k, for drawing items at random.
  std::vector<double> wanted_;
};

}  // namespace

std::vector<DataPass> run_data(const Setup& setup, const network::Routing& routing,
                               const DataLoad& load) {
  const int n = routing.processors();
  CompiledMachine machine(setup, n);
  const auto catalogue = shared_memory::make_catalogue(load.items, load.item_bytes);
  auto params = load.network;
  params.longest = longest_message(setup.model, catalogue, load.data);
  network::Network network(machine, routing, params);
  shared_memory::VirtualMemory memory(machine, network, catalogue, load.data);
  Test test(network.routing(), load, memory);
  for (int id = 0; id < n; ++id)
    machine[id].start(machine[id].name() + ".application", Priority::low,
                      [&, id] { test.live(id); });
  observe::ControlPanel view;
  show(view, network);
  show(view, memory);
  run_machine(setup, machine, view);
  return test.finish();
}

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
  DataLoad load;  // cache sizes, coordinator and scheme are set from the members below
  double cache_percent = 9, server_cache_percent = 0;
  int coordinator = -1;
  Scheme scheme = Scheme::in_path;
};

std::uint64_t bytes_of_percent(const DataLoad& load, const char* name, double percent) {
  const double items = std::floor(percent / 100 * load.items + 1e-9);
  base::require(items >= 1, std::string("program.") + name,
                "found {} % of {} items, expected at least one item", percent, load.items);
  return static_cast<std::uint64_t>(items) * load.item_bytes;
}

int find_coordinator(const Setup& setup, const Params& params) {
  const auto& topology = setup.topology;
  if (params.coordinator >= topology.processors)
    base::refuse("program.coordinator",
                 "found {}, expected a processor of {}: 0 to {}, or -1 for its root",
                 params.coordinator, topology.name, topology.processors - 1);
  if (topology.processors < 2)
    base::refuse("network",
                 "found {}, expected at least two processors: the coordinator makes no accesses",
                 topology.name);
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

Outcome<DataPass> run(const Setup& setup, const Params& params) {
  return Outcome<DataPass>(
      run_data(setup, routing_of(setup, params.routers.method), make_load(setup, params)));
}

base::Fields<DataLoad> load_fields() {
  using D = base::Declare<DataLoad>;
  return {
      D::whole("items", &DataLoad::items, 1, 1e6, "", "number of items"),
      D::whole("item_bytes", &DataLoad::item_bytes, 1, 1e6, "bytes", "size of an item"),
      D::whole("accesses", &DataLoad::accesses, 1, 1e7, "",
               "accesses of each processor in each pass"),
      D::whole("passes", &DataLoad::passes, 1, 1000, "", "passes, one after the other"),
      D::number(
          "zipf", &DataLoad::zipf, 0, 10, "",
          "Zipf's exponent: item k is accessed in proportion to 1 / k^zipf; 0: all items equally")};
}

base::Fields<Params> make_fields() {
  using D = base::Declare<Params>;
  return base::join(
      base::lift_all<Params>(router_fields(), &Params::routers),
      {base::lift_all<Params>(load_fields(), &Params::load),
       {D::number("cache_percent", &Params::cache_percent, 0, 100, "%",
                  "size of a cache, as a share of all items"),
        D::number("server_cache_percent", &Params::server_cache_percent, 0, 100, "%",
                  "size of the coordinator's cache, as a share of all items; 0: cache_percent"),
        D::whole(
            "page_items", [](auto& p) -> auto& { return p.load.data.page_items; }, 1, 1e6, "",
            "items in a page, for scheme = \"pages\""),
        D::whole("coordinator", &Params::coordinator, -1, 1e6, "",
                 "number of the coordinator's processor; -1: the network's root"),
        D::choice("scheme", &Params::scheme, SCHEMES,
                  "in-path: requests are offered to every processor on the path to the "
                  "coordinator; no-queue: likewise, without WRQu; direct: they go directly to it; "
                  "pages: fixed pages without a coordinator"),
        D::choice(
            "between_passes", [](auto& p) -> auto& { return p.load.together; }, BETWEEN_PASSES,
            "wait: every processor waits for the last one; go-on: each continues at once"),
        D::choice(
            "coordinator_is", [](auto& p) -> auto& { return p.load.coordinator_too; },
            COORDINATOR_IS, "working: it makes accesses like the others (always with pages)"),
        seed_field<Params>(
            [](auto& p) -> auto& { return p.load.seed; }, "seed for the accesses")}});
}

// Makes the columns. Inserts requests_at_coordinator behind the column requests.
base::Columns<DataPass> make_columns() {
  auto data = base::lift_columns<DataPass>(shared_memory::data_columns(), &DataPass::use);
  data.insert(
      std::ranges::find(data, "requests", &base::Column<DataPass>::name) + 1,
      column("requests_at_coordinator", &DataPass::server_seen,
             "requests that reached the coordinator; empty with between_passes = \"go-on\""));
  return base::join<base::Column<DataPass>>(
      {column("pass", &DataPass::number, "number of the pass, from 1"),
       column("time_s", &DataPass::time_s,
              "time from the end of the previous pass until the last processor finishes"),
       column("time_mean_s", &DataPass::mean_s, "mean time of a processor in the pass")},
      {std::move(data)});
}

}  // namespace

Program make_data() {
  return make_program<Params, DataPass>(
      {.name = "data",
       .help = "every processor but the coordinator makes random accesses to common items",
       .uses = {.network = true, .routes = true, .others = true},
       .fields = make_fields(),
       .columns = make_columns(),
       .parts = {"pass"},
       .run = &run});
}

}  // namespace programs

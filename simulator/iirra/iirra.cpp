#include "simulator/iirra/iirra.hpp"

#include <algorithm>
#include <bit>
#include <deque>

#include "simulator/iirra/services.hpp"
#include "simulator/iirra/worker.hpp"
#include "simulator/programs/declare/routers.hpp"
#include "simulator/ray_tracing/snapshot_fields.hpp"
#include "topologies/route/routes.hpp"

namespace iirra {

namespace {

// Maximum length of a message in bytes. A single data record may need a longer message.
constexpr std::uint64_t LONGEST = 2048;
constexpr int DATA_BIT = 1 << shared_memory::DATA_PROCESS, TASK_BIT = 1 << TASK_PROCESS;
constexpr int TASK_BITS = DATA_BIT | TASK_BIT;
constexpr int DISPLAY_BITS = DATA_BIT | 1 << DISPLAY_PROCESS;
constexpr int NO_PROCESS = 0;  // the client that sends the user's orders receives no messages

// Returns the workers closest to worker `self`: all those at the smallest distance from it.
std::vector<int> find_nearest(const network::Routing& routing, const std::vector<int>& workers,
                              int self) {
  std::vector<int> nearest;
  int least = -1;
  for (const int other : workers) {
    if (other == self) continue;
    const int distance = routing.distance(self, other);
    if (least < 0 || distance < least) {
      least = distance;
      nearest.clear();
    }
    if (distance == least) nearest.push_back(other);
  }
  return nearest;
}

// For each processor: its parent in the tree along which tasks are requested. Used by green
// balancing.
std::vector<int> find_parents(const topologies::Topology& topology, const Places& places) {
  const auto tree = topologies::make_spanning_tree(topology, places.coordinator);
  base::require(
      tree.children[static_cast<std::size_t>(places.display)].empty(), "iirra.balance",
      "found green, but the display (processor {}) separates workers from the coordinator in the "
      "spanning tree of {}: expected another method, or iirra.display = \"far\"",
      describe_processor(topology, places.display), topology.name);
  return tree.parent;
}

std::shared_ptr<const CellQuadrants> make_quadrants(const Params& params) {
  if (params.pixels != ray_tracing::PixelOrder::quadrants) return nullptr;
  return std::make_shared<const CellQuadrants>(
      make_cell_quadrants(get_area(params.image), params.max_cell));
}

machine::Cycles cost_of_testing(const machine::Model& model) {
  return kernels::central_cost(model, "pixel_tested");
}

machine::OperationCosts costs_of_tasks(const machine::Model& model) {
  return {model, "central", TaskWork::NAMES};
}

class Run {
 public:
  Run(const Setup& setup, const renderer::Scene& scene, const Params& params)
      : setup_(setup),
        params_(params),
        topology_(setup.topology),
        machine_(setup.model, machine::Code::compiled, setup.engine),
        items_(params.data
                   ? std::optional<shared_memory::SceneItems>(std::in_place, setup.model, scene)
                   : std::nullopt),
        shared_{.setup = setup,
                .scene = scene,
                .params = params,
                .machine = machine_,
                .places = find_places(setup.topology, params.is_far),
                .area = get_area(params.image),
                .sizes = Sizes(setup.model),
                .longest = LONGEST,
                .task_cost = {setup.model, &costs_of_tasks},
                .pixel_tested = {setup.model, &cost_of_testing},
                .ray_cost = {"ray", {setup.model, &kernels::tree_costs}, setup.cycles_per_host_s},
                .paint_cost = {"interpolation",
                               {setup.model, &kernels::tree_costs},
                               setup.cycles_per_host_s},
                .display_cost = {"display",
                                 {setup.model, &kernels::central_costs},
                                 setup.cycles_per_host_s},
                .quadrants = make_quadrants(params),
                .items = items_ ? &*items_ : nullptr,
                .orders = {params.script, observe::has_controller(setup.monitor)},
                .record = Record(params.image)} {
    add_processors(scene);
    connect();
    plan_faults();
    start();
  }

  Result run() {
    const auto end = observe::run(machine_, setup_.monitor, make_view());
    auto& record = shared_.record;
    coordinator_->end(machine_.now().value);
    record.end = end;
    // After an abort, workers may still take tasks until Stop reaches them, which is after
    // `ended_s`.
    record.last_task_s = std::min(record.last_task_s, record.ended_s);
    record.setup_s = record.begun_s;
    record.time_s = record.ended_s - record.begun_s;
    display_->end(record.time_s);
    for (const auto& [at, shown] : record.orders_s)
      if (shown)
        record.order_to_pixel_s = std::max(record.order_to_pixel_s.value_or(0), *shown - at);
    record.use = between(record.before, record.after);
    record.events = machine_.events();
    record.kernels =
        kernels::uses_of({&shared_.ray_cost, &shared_.paint_cost, &shared_.display_cost});
    Result result(std::move(record));
    const auto& workers = shared_.places.workers;
    result.workers = static_cast<int>(workers.size());
    for (const int worker : workers)
      result.mean_depth += network_->routing().distance(shared_.places.coordinator, worker);
    result.mean_depth /= result.workers;
    result.routers = network_->use();
    if (memory_)
      result.shared = {memory_->use(), result.routers, params_.data->cache_bytes,
                       result.workers * result.time_s};
    result.kernel_cycles = shared_.kernel_cycles();
    result.kernels_s = shared_.kernels_s().value;
    return result;
  }

 private:
  observe::ControlPanel make_view() {
    observe::ControlPanel view;
    view.picture = {params_.image.width, params_.image.height,
                    [this] { return &display_->rgb8(); }};
    view.sequential = [this](const auto& goes_on) {
      return ray_tracing::render_sequentially(shared_.scene, params_.image, goes_on);
    };
    const auto& record = shared_.record;
    view.count_rays = [&] { return static_cast<double>(record.rays.total()); };
    view.gauges = {
        {"rays", "rays traced", view.count_rays},
        {"samples", "samples computed", [&] { return static_cast<double>(record.counts.samples); }},
        {"tasks moved", "cells moved to another worker",
         [&] { return static_cast<double>(record.counts.tasks_moved); }}};
    programs::show(view, *network_);
    if (memory_) shared_memory::show(view, *memory_);
    view.limits = [this] { return coordinator_->limits(); };
    view.phase = [this] { return coordinator_->phase(); };
    view.is_complete = [&] { return record.ended_s > 0; };
    shared_.orders.show(
        view, [this] { return coordinator_->is_null(); },
        [this](const std::vector<Order>& script) {
          Params params = params_;
          params.script = script;
          check(params, topology_);
        });
    return view;
  }

  Role role_of(int id) const {
    if (id == shared_.places.coordinator) return Role::coordinator;
    return id == shared_.places.display ? Role::display : Role::worker;
  }

  void add_processors(const renderer::Scene& scene) {
    companions_.resize(static_cast<std::size_t>(topology_.processors));
    for (int id = 0; id < topology_.processors; ++id) {
      ray_tracing::check_label(topology_, id);
      const Role role = role_of(id);
      const bool is_worker = role == Role::worker;
      auto& processor = machine_.add_processor(
          name_of(topology_, id, is_worker ? fmt::format("worker{}", id) : to_string(role)),
          params_.memory.value_or(
              get_bytes(setup_.model_of(id), is_worker ? "worker_memory" : "database_memory")),
          to_string(is_worker && params_.is_double ? Role::router : role),
          programs::find_model(setup_.others, id));
      kernels::load_program(processor);
      if (is_worker && !params_.data)
        processor.memory().allocate(kernels::scene_bytes(processor.model(), scene), "the scene",
                                    {});
      if (is_worker)
        processor.memory().allocate(kernels::texture_bytes(processor.model(), scene), "textures",
                                    {});
      if (role == Role::display)
        processor.memory().allocate(7 * static_cast<std::uint64_t>(params_.image.width) *
                                        static_cast<std::uint64_t>(params_.image.height),
                                    "the picture and the age of each pixel", {});
    }
    if (!params_.is_double) return;
    for (const int id : shared_.places.workers) {
      auto& router = *machine_.processors()[id];
      companions_[id] =
          &machine_.add_companion(router, router.name() + ".second", to_string(Role::worker));
    }
  }

  void connect() {
    network::Params network;
    network.method = params_.method;
    // Each router has buffers for one or two requests per worker and for the polls of the display.
    // If they are too few, the run ends with a fault that names the router.
    network.buffers = params_.buffers.value_or(static_cast<std::size_t>(topology_.processors) + 64);
    if (params_.data)
      shared_.longest =
          std::max(LONGEST, longest_message(setup_.model, items_->catalogue(), *params_.data));
    network.longest = shared_.longest;
    network.processes.assign(static_cast<std::size_t>(topology_.processors), {TASK_BITS});
    network.processes[static_cast<std::size_t>(shared_.places.coordinator)].push_back(NO_PROCESS);
    network.processes[static_cast<std::size_t>(shared_.places.display)] = {DISPLAY_BITS};
    network.companions.assign(companions_.begin(), companions_.end());
    if (params_.is_double)
      for (const int id : shared_.places.workers)
        network.processes[static_cast<std::size_t>(id)] = {DATA_BIT, TASK_BIT};
    network_.emplace(machine_, make_routing(params_.method, topology_, setup_.routes, setup_.tree),
                     network);
    if (params_.data) {
      auto data = *params_.data;
      data.coordinator = shared_.places.coordinator;
      memory_.emplace(machine_, *network_, items_->catalogue(), data, 0, companions_);
    }
  }

  // Schedules the faults of the experiment. If a processor stops, its image cells are lost and the
  // run fails.
  void plan_faults() {
    programs::plan_faults(
        machine_, setup_.faults, [this](int id) -> auto& {
          return *machine_.processors()[static_cast<std::size_t>(id)];
        });
    machine_.on_failure([this](const machine::Failure& failure) {
      if (failure.b) return;
      const auto& survivor =
          failure.a->id() == 0 ? machine_.processors()[1] : machine_.processors()[0];
      survivor->fail(std::make_exception_ptr(
          machine::Fault(failure.a->name(), failure.at,
                         fmt::format("{} stopped at {:.6g} s: its part of the picture is lost",
                                     failure.a->name(), failure.at.value))));
    });
  }

  shared_memory::DataManager& manager(int id) {
    if (memory_) return memory_->manager(id);
    return *whole_.emplace_back(shared_memory::make_whole_manager(
        *network_, machine_.processors()[static_cast<std::size_t>(id)]->model(), id));
  }

  void start() {
    const auto& places = shared_.places;
    const auto parents = params_.balance == BalanceMethod::green
                             ? find_parents(topology_, places)
                             : std::vector<int>(static_cast<std::size_t>(topology_.processors));
    const auto& processors = machine_.processors();
    const auto start_on = [&](int id, const char* name, machine::Process::Body body) -> auto& {
      return kernels::start(*processors[id], name, machine::Priority::low, std::move(body));
    };
    coordinator_.emplace(shared_, manager(places.coordinator),
                         network_->client(places.coordinator, 1));
    shared_.record.coordination =
        start_on(places.coordinator, "coordination", [this] { coordinator_->run(); }).id();
    display_.emplace(shared_, manager(places.display));
    start_on(places.display, "visualisation", [this] { display_->run(); });
    for (std::size_t i = 0; i < places.workers.size(); ++i) {
      const int id = places.workers[i];
      Peers peers{id, places.coordinator, find_nearest(network_->routing(), places.workers, id),
                  places.workers[(i + 1) % places.workers.size()],
                  parents[static_cast<std::size_t>(id)]};
      auto& worker = workers_.emplace_back(shared_, manager(id), std::move(peers));
      const auto* companion = companions_[static_cast<std::size_t>(id)];
      start_on(companion ? companion->id() : id, "application", [&worker] { worker.run(); });
    }
  }

  const Setup& setup_;
  const Params& params_;
  const topologies::Topology& topology_;
  machine::Machine machine_;
  // By processor; null for a processor without a companion.
  std::vector<machine::Processor*> companions_;
  std::optional<shared_memory::SceneItems> items_;
  Shared shared_;
  std::optional<network::Network> network_;
  std::optional<shared_memory::VirtualMemory> memory_;  // only if the scene is distributed
  std::vector<std::unique_ptr<shared_memory::DataManager>> whole_;
  std::optional<Coordinator> coordinator_;
  std::optional<Display> display_;
  std::deque<Worker> workers_;
};

bool is_power_of_two(int n) { return n > 0 && std::has_single_bit(static_cast<unsigned>(n)); }

void check_weights(const char* key, const Weights& w) {
  base::require(w.position + w.size + w.samples + w.contrast + w.depth + w.influence > 0, key,
                "found only weights of 0, expected at least one above 0");
}

// Checks the limits of a stage or an order. `key` is the name that an error shows.
void check_limits(const std::string& key, const renderer::Params& image, const Limits& limits) {
  renderer::Params with_area = image;
  with_area.area = limits.area;
  try {
    check(with_area);
  } catch (const base::BadInput& error) {
    throw base::BadInput(fmt::format("{}.{}", key, error.what()));
  }
  const auto computed = get_area(image), asked = get_area(with_area);
  const bool is_met = asked.x < computed.x + computed.width && computed.x < asked.x + asked.width &&
                      asked.y < computed.y + computed.height && computed.y < asked.y + asked.height;
  base::require(
      is_met, key + ".area",
      "found [{}, {}, {}, {}], expected an area that overlaps image.area, [{}, {}, {}, {}]",
      asked.x, asked.y, asked.width, asked.height, computed.x, computed.y, computed.width,
      computed.height);
  if (limits.weights) check_weights((key + ".weights").c_str(), *limits.weights);
}

}  // namespace

void check(const Params& params, const topologies::Topology& topology) {
  check(params.image);
  const auto area = get_area(params.image);
  if (!is_power_of_two(params.max_cell) || params.max_cell < 2 || params.max_cell > MAX_CELL)
    base::refuse("iirra.cell", "found {}, expected a power of two from 2 to {}", params.max_cell,
                 MAX_CELL);
  if (params.max_cell > std::min(area.width, area.height))
    base::refuse("iirra.cell", "found {}, expected at most the side of the image, {} x {} pixels",
                 params.max_cell, area.width, area.height);
  check_weights("iirra.weights", params.weights);
  base::require(!params.is_double || params.data, "iirra.node",
                "found double, expected single, or data.cache_percent above 0: without data "
                "managers every worker holds the scene");
  base::require(!params.stages.empty(), "stage", "found none, expected at least one");
  for (const auto& limits : params.stages) check_limits("stage", params.image, limits);
  for (const auto& order : params.script)
    if (const auto* limits = std::get_if<Limits>(&order.what))
      check_limits("order", params.image, *limits);
  ray_tracing::check_script(params.script);
  ray_tracing::check_snapshots("iirra", params.snapshot_times, params.image);
  const auto places = find_places(topology, params.is_far);
  if (params.balance == BalanceMethod::green) find_parents(topology, places);
}

Result run_iirra(const Setup& setup, const renderer::Scene& scene, const Params& params) {
  check(params, setup.topology);
  return Run(setup, scene, params).run();
}

}  // namespace iirra

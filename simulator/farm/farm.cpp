#include "simulator/farm/farm.hpp"

#include <bit>

#include "simulator/farm/wiring.hpp"
#include "simulator/farm/worker.hpp"
#include "simulator/machine/faults.hpp"

namespace farm {

using machine::Machine;
using machine::Priority;
using machine::Processor;

namespace {

void check_area(renderer::Params image, const renderer::Area& area) {
  image.area = area;
  check(image);
}

}  // namespace

void check(const Params& params) {
  check(params.image);
  if (params.max_cell < 1 || !std::has_single_bit(static_cast<unsigned>(params.max_cell)))
    throw machine::InvalidInput(
        fmt::format("max_cell: found {}, expected a power of two", params.max_cell));
  if (params.stages.empty()) throw machine::InvalidInput("stages: at least one is needed");
  for (const Limits& limits : params.stages) check_area(params.image, limits.area);
  for (const Order& order : params.script)
    if (const auto* limits = std::get_if<Limits>(&order.command.content))
      check_area(params.image, limits->area);
  for (std::size_t i = 1; i < params.script.size(); ++i)
    if (params.script[i].at < params.script[i - 1].at)
      throw machine::InvalidInput(fmt::format("order {}: its time, {} s, is before the last one's",
                                              i + 1, params.script[i].at.value));
}

namespace {

std::vector<Order> make_script(const Params& params) {
  std::vector<Order> script = params.script;
  script.insert(script.begin(), Order{{0}, {Begin{}}});
  script.push_back({{0}, {Quit{}}});
  return script;
}

void load_program(Processor& processor) {
  processor.memory().allocate(get_bytes(processor.model(), "program"), "the program",
                              processor.now());
}

// The worker's copy of the scene, in its memory.
void load_scene(Processor& worker, const renderer::Scene& scene) {
  const auto& model = worker.model();
  auto& memory = worker.memory();
  memory.allocate(object_count(scene) * get_bytes(model, "object"), "the scene's objects",
                  worker.now());
  memory.allocate(box_count(scene) * get_bytes(model, "box"), "the scene's hierarchy",
                  worker.now());
}

// The initial rays are all deposited before the first is taken: better to say at once that they do
// not fit.
void check_initial_rays(Processor& database, const renderer::Params& image, std::uint64_t ray) {
  const renderer::Area area = get_area(image);
  const std::uint64_t bytes =
      ray * static_cast<std::uint64_t>(area.width) * static_cast<std::uint64_t>(area.height);
  database.memory().allocate(bytes, "the initial rays", database.now());
  database.memory().release(bytes);
}

}  // namespace

Result run_farm(const machine::Model& model, const topologies::Topology& topology,
                const renderer::Scene& scene, const Params& params) {
  check(params);
  const RecordBytes bytes{static_cast<std::uint32_t>(get_bytes(model, "ray")),
                          static_cast<std::uint32_t>(get_bytes(model, "hit"))};
  const std::uint64_t small = params.worker_memory.value_or(get_bytes(model, "worker_memory"));
  const std::uint64_t large = params.database_memory.value_or(get_bytes(model, "database_memory"));

  Machine machine(model, model.software.occam_factor);
  Wires wires;
  Processor& coordinator = machine.add_processor("coordinator", small);
  Processor& database = machine.add_processor("database", large);
  Processor& display = machine.add_processor("display", large);
  machine.connect(coordinator, database);
  machine.connect(coordinator, display);

  for (Processor* central : {&coordinator, &database, &display}) load_program(*central);
  check_initial_rays(database, params.image, bytes.ray);
  display.memory().allocate(get_bytes(model, "pixel") *
                                static_cast<std::uint64_t>(params.image.width) *
                                static_cast<std::uint64_t>(params.image.height),
                            "the image", display.now());

  // The workers.
  Kernel kernel{scene, params.image.traversal,
                KernelCost(machine::OperationCosts(model, "intersection", renderer::op_names()),
                           params.cycles_per_host_s, params.profile),
                bytes};
  const Workers workers = wire_workers(wires, machine, topology, coordinator, small);
  for (std::size_t id = 0; id < workers.processors.size(); ++id) {
    load_program(*workers.processors[id]);
    load_scene(*workers.processors[id], scene);
    start_worker(wires, workers, id, kernel);
  }

  // The central processes.
  const Cells cells{params.image.width, params.max_cell};
  const auto script = make_script(params);
  observe::Use before, after;
  RayDatabase rays{RayStores(cells, params.stages[0]),
                   machine::OperationCosts(model, "central", DatabaseWork::NAMES), bytes};
  const machine::OperationCosts central(model, "central", renderer::op_names());
  Visualisation visualisation{
      scene, params.image, central, renderer::Samples(params.image.width, params.image.height), {}};
  const CoordinationSetup setup{.scene = scene,
                                .params = params.image,
                                .cost = central,
                                .bytes = bytes,
                                .cells = cells,
                                .seed = params.seed,
                                .stages = params.stages,
                                .on_begin = [&] { before = observe::collect(machine); },
                                .on_end = [&] { after = observe::collect(machine); }};
  CoordinationResult coordinated;  // up to the end, if the run is cut short

  Channel<Command> from_interaction("coordinator.from.interaction");
  Channel<DatabaseRequest> into_database("database.from.coord",
                                         machine.link(coordinator, database));
  Channel<DatabaseReply> from_database("coordinator.from.database",
                                       machine.link(database, coordinator));
  Channel<Intersection> into_visualisation("display.inp", machine.link(coordinator, display));
  const Way first = start_sender(wires, coordinator, *workers.from_left[workers.root]);

  start(coordinator, "interaction", Priority::low, [&] { interaction(script, from_interaction); });
  start(coordinator, "coordination", Priority::low, [&] {
    coordination(setup,
                 {from_interaction, first.free, first.into, *workers.results[workers.root],
                  into_database, from_database, into_visualisation},
                 coordinated);
  });
  // Alone on their processors: the priority does not matter.
  start(database, "ray.database", Priority::high, [&] { rays.run(into_database, from_database); });
  start(display, "visualisation", Priority::high, [&] { visualisation.run(into_visualisation); });

  observe::Watch unwatched, &watch = params.watch ? *params.watch : unwatched;
  Result result;
  result.end = observe::run(machine, watch);
  if (result.end == machine::End::done)
    machine::check_equal("rays left in the database", rays.stores.size(), std::size_t{0});
  else if (coordinated.phase != CoordinationResult::Phase::ended) {
    after = observe::collect(machine);
    if (coordinated.phase == CoordinationResult::Phase::setup) before = after;
    coordinated.cut(machine.now());
  }

  result.samples = std::move(visualisation.samples);
  result.key_images = std::move(visualisation.key_images);
  result.rays = coordinated.rays;
  result.time_s = (coordinated.ended - coordinated.begun).value;
  result.interactive_s = (coordinated.interactive_ended - coordinated.begun).value;
  result.setup_s = coordinated.begun.value;
  result.peaks = rays.stores.peaks();
  result.peak_rays_in_farm = coordinated.peak_rays_in_farm;
  result.use = between(before, after);
  result.events = watch.events;
  result.kernel_host_s = kernel.cost.host_s();
  result.kernel_cycles = kernel.cost.charged();
  return result;
}

}  // namespace farm

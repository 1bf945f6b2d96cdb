#include "simulator/farm/farm.hpp"

#include "simulator/farm/wiring.hpp"
#include "simulator/farm/worker.hpp"
#include "simulator/ray_tracing/snapshot_fields.hpp"

namespace farm {

using machine::Machine;
using machine::Priority;
using machine::Processor;
using ray_tracing::PixelOrder;

namespace {

// The processors at the farm's centre. The coordinator has a link to each of the other two.
struct CentralProcessors {
  machine::Processor &coordinator, &database, &display;
};

CentralProcessors add_central_processors(machine::Machine& machine, const Params& params) {
  const auto small = worker_memory(machine.model(), params);
  const auto large = database_memory(machine.model(), params);
  const auto add = [&](Role role, std::uint64_t memory) -> Processor& {
    return add_processor(machine, to_string(role), memory, role);
  };
  CentralProcessors on{add(Role::coordinator, small), add(Role::database, large),
                       add(Role::display, large)};
  machine.connect(on.coordinator, on.database);
  machine.connect(on.coordinator, on.display);
  return on;
}

// Makes the tiling of the image by cells. The first cell starts at the first rendered pixel.
Cells make_cells(const Params& params) {
  const renderer::Area area = get_area(params.image);
  Cells cells{params.image.width, params.max_cell, area.x, area.y, params.order};
  if (params.pixels == PixelOrder::cells) return cells;
  cells.max_cell = 1;
  cells.order = CellOrder::sequential;
  if (params.pixels == PixelOrder::quadrants)
    cells.quadrants = std::make_shared<const renderer::progressive::QuadrantOrder>(
        renderer::progressive::make_order(area));
  return cells;
}

FrameBuffer make_picture(const Params& params) {
  return {params.image.width,     params.image.height,
          make_cells(params),     params.cells,
          get_area(params.image), params.block ? renderer::Sampling() : params.image.sampling};
}

// Cost of the kernel `name`, which runs on the coordinator or on the display.
kernels::KernelCost central_cost(const char* name, const Setup& setup) {
  return {name, {setup.model, &kernels::central_costs}, setup.cycles_per_host_s};
}

// Bytes of scene data on the display: surfaces with their textures, and lights (thesis, 4.3.6.6).
// To draw a preview, the display needs the whole scene.
std::uint64_t display_bytes(const machine::Model& model, const renderer::Scene& scene,
                            const Params& params) {
  return scene.surfaces.size() * get_bytes(model, "surface") +
         scene.lights.size() * get_bytes(model, "light") + kernels::texture_bytes(model, scene) +
         (params.preview ? kernels::scene_bytes(model, scene) : 0);
}

machine::Cycles cost_of_preview(const machine::Model& model, const renderer::Preview& preview) {
  static constexpr std::string_view NAMES[] = {"vertex_projected", "pixel_tested", "pixel_drawn"};
  const auto& counts = preview.counts;
  return kernels::tree_costs(model)(preview.work.counts) +
         machine::OperationCosts(model, "central", NAMES)(
             std::array{counts.vertices, counts.pixels_tested, counts.pixels_drawn});
}

// Refuses a ray database with too little memory for all initial rays. The coordination process
// stores all of them before it sends the first.
void check_initial_rays(Processor& database, const Params& params, std::uint64_t ray) {
  const renderer::Area area = get_area(params.image);
  const bool is_adaptive =
      params.order == CellOrder::adaptive && params.pixels == PixelOrder::cells;
  const int cell = is_adaptive ? params.max_cell : 1;
  const auto cells = [cell](int side) { return static_cast<std::uint64_t>((side - 1) / cell + 1); };
  const std::uint64_t bytes = ray * cells(area.width) * cells(area.height);
  database.memory().allocate(bytes, "the initial rays", database.now());
  database.memory().release(bytes);
}

std::string describe_phase(const Progress& progress) {
  if (progress.is_null) return "null mode: nothing is left within the limits";
  if (progress.is_aborted) return "aborted";
  switch (progress.phase) {
    case Progress::Phase::setup:
      return "setting up";
    case Progress::Phase::interactive:
      return "interactive";
    case Progress::Phase::non_interactive:
      return "non-interactive";
    case Progress::Phase::ended:
      return "complete";
  }
  return "";
}

// The three central processors with their processes, data and channels (thesis, figures 4.9 to
// 4.11).
class Centre {
 public:
  /// `tasks` is the cost of the workers' tasks.
  Centre(machine::Machine& machine, const Setup& setup, const renderer::Scene& scene,
         const Params& params, const kernels::KernelCost& tasks);
  Centre(const Centre&) = delete;

  machine::Processor& coordinator() { return on_.coordinator; }
  // Starts the central processes. The coordination process distributes rays or blocks of pixels.
  void start(Wires& wires, const Workers& workers) {
    const Way first = start_sender(wires, on_.coordinator, *workers.from_left[workers.root]);
    const CoordinationChannels channels{
        from_interaction_, first.free,     first.into,         *workers.results[workers.root],
        into_database_,    from_database_, into_visualisation_};
    const std::size_t n = workers.processors.size();
    kernels::start(on_.coordinator, "interaction", Priority::low,
                   [this] { interaction(orders_, progress_, from_interaction_); });
    const auto coordinate = [this, channels, n] {
      if (params_.block)
        block_coordination(make_blocks(params_.image, *params_.block), scene_messages(n), channels,
                           progress_);
      else
        coordination(make_ray_setup(n), channels, progress_);
    };
    coordination_ = kernels::start(on_.coordinator, "coordination", Priority::low, coordinate).id();
    // Each of these processes has a processor of its own, so its priority is irrelevant.
    kernels::start(on_.database, "ray.database", Priority::high,
                   [this] { rays_.run(into_database_, from_database_); });
    kernels::start(on_.display, "visualisation", Priority::high, [this] {
      if (params_.preview) draw_preview(*params_.preview);
      visualisation_.run(into_visualisation_);
    });
  }

  // The live view of the run, which also accepts the user's orders.
  observe::ControlPanel make_view();

  // The cost objects of the two central kernels: shading and display.
  std::pair<const kernels::KernelCost*, const kernels::KernelCost*> kernels() const {
    return {&shading_, &visualisation_.cost};
  }

  // The result of the central processes, still without the data of the workers.
  Result take_result(machine::End end) {
    if (end == machine::End::done && !progress_.is_aborted)
      base::check_equal("rays left in the database", rays_.stores.size(), std::size_t{0});
    Result result = make_result(progress_, visualisation_, end);
    result.is_aborted = progress_.is_aborted;
    if (rays_.longest_pause_s > 0) result.reorder_pause_s = rays_.longest_pause_s;
    for (const auto& [at, shown] : progress_.orders_shown)
      if (shown)
        result.order_to_pixel_s =
            std::max(result.order_to_pixel_s.value_or(0), (*shown - at).value);
    result.coordination = coordination_;
    result.interactive_s = progress_.interactive_s;
    result.peaks = rays_.stores.peaks();
    return result;
  }

 private:
  // Draws the preview before the first ray. The display's memory must hold the scene's objects.
  void draw_preview(renderer::PreviewStep step) {
    const auto preview = make_preview(scene_, params_.image, step);
    occam::this_process().charge(cost_of_preview(machine_.model(), preview));
    visualisation_.picture.set_background(make_rgb8(preview.samples));
    visualisation_.key_images.push_back(
        {occam::this_process().now(), "preview", visualisation_.picture.rgb8()});
  }

  SceneMessages scene_messages(std::size_t workers) const {
    if (params_.scene_message == 0) return {};
    const auto& model = machine_.model();
    return {kernels::scene_bytes(model, scene_), params_.scene_message,
            display_bytes(model, scene_, params_), workers};
  }

  CoordinationSetup make_ray_setup(std::size_t workers) {
    return {.scene = scene_,
            .params = params_.image,
            .cost = shading_,
            .bytes = bytes_,
            .message = message_,
            .cells = make_cells(params_),
            .seed = params_.seed,
            .load = scene_messages(workers),
            .stages = params_.stages,
            .cell_judged = kernels::central_cost(machine_.model(), "cell_judged")};
  }

  machine::Machine& machine_;
  const Params& params_;
  const renderer::Scene& scene_;
  kernels::RecordBytes bytes_;
  kernels::MessageCosts message_;
  CentralProcessors on_;
  kernels::KernelCost shading_;
  RayDatabase rays_;
  ray_tracing::Orders<Limits> orders_;
  Progress progress_;
  Visualisation visualisation_;
  machine::ProcessId coordination_ = 0;

  Channel<Command> from_interaction_;
  Channel<DatabaseRequest> into_database_;
  Channel<DatabaseReply> from_database_;
  Channel<Answer> into_visualisation_;
};

Centre::Centre(machine::Machine& machine, const Setup& setup, const renderer::Scene& scene,
               const Params& params, const kernels::KernelCost& tasks)
    : machine_(machine),
      params_(params),
      scene_(scene),
      bytes_(kernels::record_bytes(machine.model())),
      message_(kernels::message_costs(machine.model())),
      on_(add_central_processors(machine, params)),
      shading_(central_cost("shading", setup)),
      rays_{RayStores(make_cells(params), params.stages[0], params.weights),
            machine::OperationCosts(machine.model(), "central", DatabaseWork::NAMES), bytes_,
            message_},
      orders_(params.script, !params.block && observe::has_controller(setup.monitor)),
      progress_(machine),
      visualisation_(make_visualisation(setup, scene, params, progress_,
                                        [&tasks] { return tasks.charged(); })),
      from_interaction_("coordinator.from.interaction"),
      into_database_("database.from.coord", machine.link(on_.coordinator, on_.database),
                     occam::Protocol::variant),
      from_database_("coordinator.from.database", machine.link(on_.database, on_.coordinator),
                     occam::Protocol::variant),
      into_visualisation_("display.inp", machine.link(on_.coordinator, on_.display),
                          occam::Protocol::variant) {
  progress_.limits = params.stages[0];
  if (!params.block) check_initial_rays(on_.database, params, bytes_.ray);
  allocate_image(on_.display, params.image);
  on_.display.memory().allocate(display_bytes(machine.model(), scene, params),
                                "surfaces and lights", on_.display.now());
}

observe::ControlPanel Centre::make_view() {
  auto view = farm::make_view(visualisation_);
  view.sequential = [this](const auto& goes_on) {
    return ray_tracing::render_sequentially(scene_, params_.image, goes_on);
  };
  const auto& stores = rays_.stores;
  view.gauges.push_back({"rays in the database", "rays waiting in all stores of the ray database",
                         [&stores] { return static_cast<double>(stores.size()); }});
  view.gauges.push_back({"tasks", "tasks handed out to the workers",
                         [this] { return static_cast<double>(progress_.tasks); }});
  view.inspections.emplace_back([this, &stores](int processor) {
    if (processor != on_.database.id()) return std::vector<observe::ControlPanel::Reading>{};
    const auto lengths = stores.lengths();
    return std::vector<observe::ControlPanel::Reading>{
        {"shadow feelers", static_cast<double>(lengths.feelers)},
        {"rays in the priority queue", static_cast<double>(lengths.heap)},
        {"rays beyond the limits", static_cast<double>(lengths.later)}};
  });
  view.phase = [this] { return describe_phase(progress_); };
  view.is_complete = [this] {
    const bool has_no_ray = progress_.is_null && rays_.stores.size() == 0;
    return has_no_ray || progress_.phase == Progress::Phase::ended;
  };
  if (params_.block) return view;
  view.limits = [this] { return progress_.limits; };
  orders_.show(
      view, [this] { return progress_.is_null; },
      [this](const std::vector<Order>& script) {
        Params params = params_;
        params.script = script;
        check(params);
      });
  return view;
}

observe::ControlPanel make_view(Centre& centre, const Workers& workers) {
  auto view = centre.make_view();
  for (const auto* worker : workers.processors) view.network.push_back(worker->id());
  return view;
}

// Allocates the worker's copy of the scene. The copy includes textures if the worker shades.
void load_scene(Processor& worker, const renderer::Scene& scene, bool shades) {
  const auto& model = worker.model();
  auto& memory = worker.memory();
  memory.allocate(object_count(scene) * get_bytes(model, "object"), "the scene's objects",
                  worker.now());
  memory.allocate(box_count(scene) * get_bytes(model, "box"), "the scene's hierarchy",
                  worker.now());
  if (shades)
    memory.allocate(kernels::texture_bytes(model, scene), "the scene's textures", worker.now());
}

Kernel make_kernel(const Setup& setup, const renderer::Scene& scene, const Params& params) {
  const auto& [model, host] = std::tie(setup.model, setup.cycles_per_host_s);
  return {scene,
          params.image,
          kernels::KernelCost("ray", {model, &kernels::intersection_costs}, host, setup.profile),
          kernels::KernelCost("block", {model, &kernels::tree_costs}, host, setup.profile),
          kernels::record_bytes(model),
          {model, &kernels::message_costs}};
}

}  // namespace

Result run_farm(const Setup& setup, const renderer::Scene& scene, const Params& params) {
  check(params);
  Machine machine(setup.model, machine::Code::compiled, setup.engine);
  Wires wires;
  Kernel kernel = make_kernel(setup, scene, params);
  Centre centre(machine, setup, scene, params, params.block ? kernel.block : kernel.ray);
  const Workers workers = wire_workers(wires, machine, centre.coordinator(), setup, params);
  for (std::size_t id = 0; id < workers.processors.size(); ++id) {
    load_scene(*workers.processors[id], scene, params.block.has_value());
    start_worker(wires, workers, id, kernel);
  }
  centre.start(wires, workers);
  programs::plan_faults(
      machine, setup.faults, [&](int id) -> auto& {
        return *workers.processors.at(static_cast<std::size_t>(id));
      });

  Result result =
      centre.take_result(observe::run(machine, setup.monitor, make_view(centre, workers)));
  add_workers(result, setup.topology, workers.topology, kernel.done);
  result.mean_depth = workers.mean_depth;
  result.events = machine.events();
  result.kernel_host_s = kernel.ray.profile_s() + kernel.block.profile_s();
  result.kernel_cycles = kernel.ray.charged() + kernel.block.charged();
  const auto [shading, display] = centre.kernels();
  result.kernels = kernels::uses_of({&kernel.ray, &kernel.block, shading, display});
  return result;
}

std::uint64_t worker_memory(const machine::Model& model, const Params& params) {
  return params.worker_memory.value_or(get_bytes(model, "worker_memory"));
}

std::uint64_t database_memory(const machine::Model& model, const Params& params) {
  return params.database_memory.value_or(get_bytes(model, "database_memory"));
}

Processor& add_processor(Machine& machine, const std::string& name, std::uint64_t memory, Role role,
                         std::shared_ptr<const machine::Model> model) {
  Processor& processor = machine.add_processor(name, memory, to_string(role), std::move(model));
  kernels::load_program(processor);
  return processor;
}

std::string worker_name(const topologies::Topology& workers, int id) {
  return name_of(workers, id, fmt::format("worker{}", id + 1));
}

Processor& add_worker(Machine& machine, const topologies::Topology& workers, int id,
                      const Setup& setup, const Params& params) {
  ray_tracing::check_label(workers, id);
  return add_processor(machine, worker_name(workers, id), worker_memory(setup.model_of(id), params),
                       Role::worker, programs::find_model(setup.others, id));
}

Visualisation make_visualisation(const Setup& setup, const renderer::Scene& scene,
                                 const Params& params, Progress& progress,
                                 std::function<machine::Cycles()> charged) {
  return {scene,
          params.image,
          central_cost("display", setup),
          kernels::message_costs(setup.model),
          make_picture(params),
          setup.cycles_per_host_s ? make_picture(params) : FrameBuffer(),
          snapshots::Recorder(params.snapshot_times, setup.monitor),
          progress,
          std::move(charged)};
}

observe::ControlPanel make_view(const Visualisation& visualisation) {
  observe::ControlPanel view;
  view.picture = {visualisation.params.width, visualisation.params.height,
                  [&visualisation] { return &visualisation.picture.rgb8(); }};
  view.count_rays = [&visualisation] { return static_cast<double>(visualisation.rays); };
  view.gauges = {{"rays", "rays that the picture shows", view.count_rays}};
  return view;
}

void add_workers(Result& result, const topologies::Topology& asked,
                 const topologies::Topology& wired, const std::map<int, std::uint64_t>& done) {
  result.topology = wired;
  if (!result.use.cpus.empty())
    for (const auto& [id, tasks] : done)
      result.use.cpus.at(static_cast<std::size_t>(id)).tasks = tasks;
  for (const auto& [a, b] : asked.links) {
    if (std::ranges::find(wired.links, topologies::Link{a, b}) != wired.links.end()) continue;
    const auto end = [&](const topologies::End& of) {
      return fmt::format("port {} of {}", of.port, worker_name(asked, of.processor));
    };
    result.notes.push_back(fmt::format(
        "the link from {} to {} is omitted: the coordinator's link uses its port",
        end(a.processor == asked.root ? a : b), end(a.processor == asked.root ? b : a)));
  }
}

void allocate_image(Processor& display, const renderer::Params& image) {
  display.memory().allocate(get_bytes(display.model(), "pixel") *
                                static_cast<std::uint64_t>(image.width) *
                                static_cast<std::uint64_t>(image.height),
                            "the image", display.now());
}

Result make_result(Progress& progress, Visualisation& visualisation, machine::End end) {
  if (end != machine::End::done) progress.cut();
  Result result;
  result.end = end;
  result.rays = progress.rays;
  result.time_s = (progress.ended - progress.begun).value;
  result.setup_s = progress.begun.value;
  result.tasks = progress.tasks;
  result.peak_tasks_in_farm = progress.peak_tasks_in_farm;
  result.drain_s = (progress.ended - progress.last_task).value;
  result.use = between(progress.before, progress.after);
  result.notes = std::move(progress.notes);
  visualisation.end(progress.ended);
  result.samples = visualisation.picture.samples();
  result.rgb8 = visualisation.picture.rgb8();
  result.pictures = visualisation.recorder.pictures();
  result.growth = visualisation.recorder.growth();
  result.key_images = std::move(visualisation.key_images);
  return result;
}

}  // namespace farm

#include "simulator/farm/centre_wiring.hpp"

#include "base/errors.hpp"
#include "simulator/kernels/placement.hpp"
#include "simulator/kernels/records.hpp"

namespace farm {

using machine::Priority;
using machine::Processor;

namespace {

CentralProcessors add_central_processors(machine::Machine& machine, const Params& params) {
  const auto small = worker_memory(machine.model(), params);
  const auto large = database_memory(machine.model(), params);
  CentralProcessors on{add_processor(machine, Role::coordinator, small, Role::coordinator),
                       add_processor(machine, Role::database, large, Role::database),
                       add_processor(machine, Role::display, large, Role::display)};
  machine.connect(on.coordinator, on.database);
  machine.connect(on.coordinator, on.display);
  return on;
}

Cells make_cells(const Params& params) { return {params.image.width, params.max_cell}; }

std::vector<Order> make_script(const Params& params) {
  std::vector<Order> script = params.script;
  script.insert(script.begin(), Order{{0}, {Begin{}}});
  script.push_back({{0}, {Quit{}}});
  return script;
}

// The initial rays are all deposited before the first is taken: a memory that they do not fit is
// refused at once.
void check_initial_rays(Processor& database, const renderer::Params& image, std::uint64_t ray) {
  const renderer::Area area = get_area(image);
  const std::uint64_t bytes =
      ray * static_cast<std::uint64_t>(area.width) * static_cast<std::uint64_t>(area.height);
  database.memory().allocate(bytes, "the initial rays", database.now());
  database.memory().release(bytes);
}

}  // namespace

Centre::Centre(machine::Machine& machine, const renderer::Scene& scene, const Params& params)
    : machine_(machine),
      params_(params),
      scene_(scene),
      bytes_(kernels::record_bytes(machine.model())),
      on_(add_central_processors(machine, params)),
      cost_(machine.model(), "central", renderer::op_names()),
      script_(make_script(params)),
      rays_{RayStores(make_cells(params), params.stages[0]),
            machine::OperationCosts(machine.model(), "central", DatabaseWork::NAMES), bytes_},
      visualisation_{scene,
                     params.image,
                     cost_,
                     renderer::Samples(params.image.width, params.image.height),
                     {}},
      progress_(machine),
      from_interaction_("coordinator.from.interaction"),
      into_database_("database.from.coord", machine.link(on_.coordinator, on_.database),
                     occam::Protocol::variant),
      from_database_("coordinator.from.database", machine.link(on_.database, on_.coordinator),
                     occam::Protocol::variant),
      into_visualisation_("display.inp", machine.link(on_.coordinator, on_.display),
                          occam::Protocol::variant) {
  if (!params.block) check_initial_rays(on_.database, params.image, bytes_.ray);
  allocate_image(on_.display, params.image);
}

SceneMessages Centre::scene_messages(std::size_t workers) const {
  if (params_.scene_message == 0) return {};
  return {kernels::scene_bytes(machine_.model(), scene_), params_.scene_message, workers};
}

CoordinationSetup Centre::make_ray_setup(std::size_t workers) const {
  return {.scene = scene_,
          .params = params_.image,
          .cost = cost_,
          .bytes = bytes_,
          .cells = make_cells(params_),
          .seed = params_.seed,
          .load = scene_messages(workers),
          .stages = params_.stages};
}

void Centre::start(Wires& wires, const Workers& workers) {
  const Way first = start_sender(wires, on_.coordinator, *workers.from_left[workers.root]);
  const CoordinationChannels channels{
      from_interaction_, first.free,     first.into,         *workers.results[workers.root],
      into_database_,    from_database_, into_visualisation_};
  const std::size_t n = workers.processors.size();
  kernels::start(on_.coordinator, "interaction", Priority::low,
                 [this] { interaction(script_, from_interaction_); });
  kernels::start(on_.coordinator, "coordination", Priority::low, [this, channels, n] {
    if (params_.block)
      block_coordination({make_blocks(params_.image, *params_.block), scene_messages(n)}, channels,
                         progress_);
    else
      coordination(make_ray_setup(n), channels, progress_);
  });
  // Alone on their processors: the priority does not matter.
  kernels::start(on_.database, "ray.database", Priority::high,
                 [this] { rays_.run(into_database_, from_database_); });
  kernels::start(on_.display, "visualisation", Priority::high,
                 [this] { visualisation_.run(into_visualisation_); });
}

Result Centre::take_result(machine::End end) {
  if (end == machine::End::done)
    base::check_equal("rays left in the database", rays_.stores.size(), std::size_t{0});
  Result result = make_result(progress_, end);
  result.samples = std::move(visualisation_.samples);
  result.key_images = std::move(visualisation_.key_images);
  result.interactive_s = (progress_.interactive_ended - progress_.begun).value;
  result.peaks = rays_.stores.peaks();
  return result;
}

}  // namespace farm

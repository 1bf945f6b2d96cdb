#include "simulator/farm/program.hpp"

#include "renderer/files/load_scene.hpp"
#include "simulator/farm/measured.hpp"

namespace farm {

using programs::Outcome;
using programs::Setup;

namespace {

// Parses the kind of task: `ray`, or `block:WxH` for a block of W x H pixels.
bool set_task(std::optional<Block>& task, const base::Scalar& value) {
  const auto& text = std::get<std::string>(value);
  if (text == "ray") {
    task.reset();
    return true;
  }
  Block block;
  int end = 0;
  if (std::sscanf(text.c_str(), "block:%5dx%5d%n", &block.width, &block.height, &end) != 2 ||
      static_cast<std::size_t>(end) != text.size() || block.width < 1 || block.height < 1)
    return false;
  task = block;
  return true;
}

base::Field<Params> task_field() {
  return base::Declare<Params>::custom(
      "task",
      {.kind = base::Domain::Kind::text, .expected = "ray, or a block of pixels such as block:8x8"},
      "", "task of a worker: ray, or a block of pixels such as block:8x8",
      [](Params& p, const base::Scalar& value) { return set_task(p.block, value); },
      [](const Params& p) {
        return p.block ? fmt::format("block:{}x{}", p.block->width, p.block->height) : "ray";
      });
}

base::Fields<Params> memory_fields() {
  using D = base::Declare<Params>;
  constexpr double MOST = 0x1p40;
  return {D::whole("worker_memory_bytes", &Params::worker_memory, 1, MOST, "bytes",
                   "memory of a worker and of the coordinator; default: the model's"),
          D::whole("database_memory_bytes", &Params::database_memory, 1, MOST, "bytes",
                   "memory of the ray database and of the display; default: the model's")};
}

constexpr double Weights::*WEIGHTS[] = {&Weights::influence, &Weights::level, &Weights::cell};
constexpr auto WEIGHTS_EXPECTED = "[influence, level, cell], three numbers from 0 to 1e6";

base::Names<std::optional<renderer::PreviewStep>> preview_names() {
  base::Names<std::optional<renderer::PreviewStep>> names{{"none", std::nullopt}};
  for (const auto& [name, step] : renderer::preview_steps()) names.emplace_back(name, step);
  return names;
}

base::Fields<Params> cell_fields() {
  using D = base::Declare<Params>;
  static const base::Names<CellOrder> ORDERS = {{"random", CellOrder::random},
                                                {"sequential", CellOrder::sequential},
                                                {"recursive", CellOrder::recursive},
                                                {"adaptive", CellOrder::adaptive}};
  static const base::Names<CellLight> LIGHTS = {{"constant", CellLight::constant},
                                                {"point", CellLight::point},
                                                {"smooth", CellLight::smooth}};
  return {D::whole("max_cell", &Params::max_cell, 1, 65536, "pixels",
                   "largest image cell, a power of two"),
          D::choice("order", &Params::order, ORDERS,
                    "order of cells of equal size; adaptive: first where neighbouring samples hit "
                    "different objects"),
          D::choice("cells", &Params::cells, LIGHTS,
                    "how a sample fills its cell: with a constant colour, as one point, or with a "
                    "smooth transition to its neighbours"),
          D::choice("preview", &Params::preview, preview_names(),
                    "preview that the display draws by z-buffer before the first ray"),
          ray_tracing::weights_field<Params>(
              WEIGHTS, &Params::weights, WEIGHTS_EXPECTED,
              "weights of influence, level and cell size in a ray's priority; "
              "[0, 0, 0]: compare them in this order instead")};
}

base::Fields<Params> farm_fields() {
  using D = base::Declare<Params>;
  return {task_field(),
          D::whole("scene_message_bytes", &Params::scene_message, 0, 1 << 24, "bytes",
                   "largest message of the scene's distribution to the workers, timed as setup_s; "
                   "0: workers already have the scene"),
          programs::whole_seed_field<Params>(&Params::seed, "seed for the order of the cells")};
}

base::Fields<Limits> limit_fields() {
  using D = base::Declare<Limits>;
  return base::join(
      ray_tracing::ray_limit_fields<Limits>(),
      {{D::whole("min_cell", &Limits::min_cell, 1, 65536, "pixels", "smallest image cell"),
        base::lift<Limits>(renderer::area_field(), &Limits::area),
        ray_tracing::weights_field<Limits>(WEIGHTS, &Limits::weights, WEIGHTS_EXPECTED,
                                           "replaces farm.weights while these limits apply")}});
}

void check_program(const Setup& setup, const ProgramParams& params) {
  check(params.machine);
  if (params.data) check_task(params.machine);
  if (params.shares_data() && params.machine.preview)
    base::refuse("farm.preview",
                 "found a preview, expected none: with data.cache_percent the "
                 "display does not hold the scene");
  if (params.shares_data() && !setup.faults.empty())
    base::refuse("[[fault]]",
                 "found one, expected none with data.cache_percent: data managers cannot continue "
                 "after a fault");
  const auto size = size_of(params.scene);
  if (params.shares_data()) check(setup.model, size, params.machine, *params.data);
}

Measured run_one(const Setup& setup, const ProgramParams& params) {
  const auto scene = renderer::load_scene(scene_source(params.scene));
  const bool has_data = params.data.has_value();
  if (!params.shares_data()) return {run_farm(setup, scene, params.machine), {has_data, {}}};
  auto result = run_shared_farm(setup, scene, params.machine, *params.data);
  return {std::move(result.farm), {has_data, std::move(result.shared)}};
}

Outcome<Measured> run(const Setup& setup, const ProgramParams& params) {
  auto outcome = make_outcome(setup, params, run_one(setup, params));
  const auto& measured = outcome.rows[0];
  if (setup.profile && !measured.data.use) outcome.kernel_host_s = measured.run.kernel_host_s;
  return outcome;
}

}  // namespace

programs::Program make_farm() {
  return ray_tracing::make_program<Limits, Params, Measured>(
      {.name = "farm",
       .help = "the farm of chapter 4: a ray tracer with increasing realism",
       .uses = {.network = true, .faults = true, .timed = true, .others = true},
       .fields = ray_tracing::program_fields("farm", memory_fields(),
                                             base::join(cell_fields(), {farm_fields()})),
       .columns = make_columns(),
       .run = &run,
       .check = &check_program,
       .shows = make_shows()},
      limit_fields());
}

}  // namespace farm

#include "simulator/farm/program.hpp"

#include "renderer/files/load_scene.hpp"
#include "simulator/farm/measured.hpp"
#include "simulator/programs/declare/support.hpp"
#include "simulator/ray_tracing/snapshot_fields.hpp"

namespace farm {

using programs::Outcome;
using programs::Setup;

namespace {

// Parses a task: `ray`, or `block:WxH` for a block of pixels.
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
  return {
      "task",
      "",
      "task of a worker: ray, or a block of pixels such as block:8x8",
      {.kind = base::Domain::Kind::text, .expected = "ray, or a block of pixels such as block:8x8"},
      [](Params& p, const base::Scalar& value) { return set_task(p.block, value); },
      [](const Params& p) -> base::Scalar {
        return p.block ? fmt::format("block:{}x{}", p.block->width, p.block->height) : "ray";
      }};
}

base::Fields<Params> memory_fields() {
  using D = base::Declare<Params>;
  constexpr double MOST = 0x1p40;
  return {D::whole("worker_memory_bytes", &Params::worker_memory, 1, MOST, "bytes",
                   "memory of a worker and of the coordinator; default: the model's"),
          D::whole("database_memory_bytes", &Params::database_memory, 1, MOST, "bytes",
                   "memory of the ray database and of the display; default: the model's")};
}

// Declares a field for the weights of P in `member`.
template <class P, class Member>
base::Field<P> weights_field(Member member, const std::string& help) {
  const auto set = [member](P& p, const base::Scalar& value) {
    const auto& weights = std::get<std::vector<double>>(value);
    const auto is_weight = [](double w) { return w >= 0 && w <= 1e6; };
    if (weights.size() != 3 || !std::ranges::all_of(weights, is_weight)) return false;
    p.*member = Weights{weights[0], weights[1], weights[2]};
    return true;
  };
  const auto get = [member](const P& p) -> base::Scalar {
    const std::optional<Weights> weights = p.*member;
    if (!weights) return {};
    return std::vector<double>{weights->influence, weights->level, weights->cell};
  };
  return {"weights",
          "",
          help,
          {.kind = base::Domain::Kind::list,
           .expected = "[influence, level, cell], three numbers from 0 to 1e6"},
          set,
          get};
}

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
          weights_field<Params>(&Params::weights,
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

base::Fields<ProgramParams> make_fields() {
  using P = ProgramParams;
  const auto image = [](auto& p) -> auto& { return p.farm.image; };
  const auto snapshot_times = [](auto& p) -> auto& { return p.farm.snapshot_times; };
  return base::join(
      base::lift_all<P>(memory_fields(), &P::farm, "machine."),
      {base::lift_all<P>(ray_tracing::scene_fields(), &P::scene),
       base::lift_all<P>(renderer::param_fields(), image, "image."),
       base::lift_all<P>(cell_fields(), &P::farm, "farm."),
       base::lift_all<P>(farm_fields(), &P::farm, "farm."),
       base::lift_all<P>(ray_tracing::snapshot_fields(), snapshot_times, "farm."),
       // In the last place, so that the key "order" without a section means farm.order instead of
       // image.order.
       base::lift_all<P>(base::Fields<Params>{ray_tracing::pixel_order_field(&Params::pixels)},
                         &P::farm, "image."),
       base::lift_optional<P>(ray_tracing::data_fields(), &P::data)});
}

base::Fields<Limits> limit_fields() {
  using D = base::Declare<Limits>;
  return {
      D::number("min_influence", &Limits::min_influence, 0, 1, "",
                "smallest influence factor of a ray"),
      D::whole("depth_reflected", &Limits::depth_reflected, 0, 1000, "",
               "deepest tree level of rays whose ancestors were only reflected"),
      D::whole("depth_transmitted", &Limits::depth_transmitted, 0, 1000, "",
               "deepest tree level of transmitted rays and their descendants"),
      D::whole("min_cell", &Limits::min_cell, 1, 65536, "pixels", "smallest image cell"),
      base::lift<Limits>(renderer::area_field(), &Limits::area),
      weights_field<Limits>(&Limits::weights, "replaces farm.weights while these limits apply")};
}

std::vector<programs::RecordList> make_lists() {
  using P = ProgramParams;
  return ray_tracing::make_lists<P>(
      limit_fields(), [](auto& p) -> auto& { return p.farm.stages; },
      [](auto& p) -> auto& { return p.farm.script; });
}

Params make_params(const Setup& setup, const ProgramParams& params) {
  Params farm = params.farm;
  farm.cycles_per_host_s = setup.cycles_per_host_s;
  farm.profile = setup.profile;
  farm.faults = setup.faults;
  farm.others = setup.others;
  farm.engine = setup.engine;
  farm.monitor = setup.monitor;
  return farm;
}

bool shares_data(const ProgramParams& params) {
  return params.data && params.data->cache_percent > 0;
}

void check_program(const Setup& setup, const ProgramParams& params) {
  check(params.farm);
  if (params.data) check_task(params.farm);
  if (shares_data(params) && params.farm.preview)
    base::refuse("farm.preview",
                 "found a preview, expected none: with data.cache_percent the "
                 "display does not hold the scene");
  if (shares_data(params) && !setup.faults.empty())
    base::refuse("[[fault]]",
                 "found one, expected none with data.cache_percent: data managers cannot continue "
                 "after a fault");
  const auto size = size_of(params.scene);
  if (shares_data(params)) check(setup.model, size, make_params(setup, params), *params.data);
}

Measured run_one(const Setup& setup, const ProgramParams& params) {
  const auto scene = renderer::load_scene(scene_source(params.scene));
  const Params farm = make_params(setup, params);
  const bool has_data = params.data.has_value();
  if (!shares_data(params))
    return {run_farm(setup.model, setup.topology, scene, farm), {has_data, {}}};
  auto result = run_shared_farm(setup.model, setup.topology, scene, farm, *params.data);
  return {std::move(result.farm), {has_data, std::move(result.shared)}};
}

Outcome<Measured> run(const Setup& setup, const ProgramParams& params) {
  Measured measured = run_one(setup, params);
  auto given =
      make_given(setup, params.scene, params.farm.image, params.farm.max_cell, measured.run);
  measured.growth = given.growth;
  Outcome<Measured> outcome;
  static_cast<programs::Extras&>(outcome) = std::move(given.extras);
  outcome.loads = measured.loads;
  if (setup.profile && !measured.data.use) outcome.kernel_host_s = measured.run.kernel_host_s;
  outcome.rows.push_back(std::move(measured));
  return outcome;
}

}  // namespace

programs::Program make_farm() {
  auto program = programs::make_program<ProgramParams, Measured>(
      {.name = "farm",
       .help = "the farm of chapter 4: a ray tracer with increasing realism",
       .uses = {.network = true, .faults = true, .timed = true, .others = true},
       .fields = make_fields(),
       .columns = make_columns(),
       .run = &run,
       .check = &check_program,
       .describe = [](const ProgramParams& params) { return describe(params.scene); },
       .lists = make_lists()});
  program.processors = "workers";
  program.shows_parameters = false;
  program.shows = make_shows();
  program.shows_picture = true;
  program.picture_key = [](const std::any& any) {
    const auto& params = std::any_cast<const ProgramParams&>(any);
    return picture_key(params.scene, params.farm.image);
  };
  program.voids = [](const std::any& any, const std::string& key) {
    return find_void(std::any_cast<const ProgramParams&>(any).scene, key);
  };
  return program;
}

}  // namespace farm

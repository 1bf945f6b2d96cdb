#include "simulator/farm/program.hpp"

#include <filesystem>

#include "renderer/files/nff.hpp"
#include "renderer/trace/params.hpp"
#include "simulator/declare/routers.hpp"
#include "simulator/farm/measured.hpp"

namespace farm {

using programs::Outcome;
using programs::Setup;

namespace {

// A task is a ray, or a block of pixels.
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
      "what a worker is given: ray, or a block of pixels, block:8x8",
      {.kind = base::Domain::Kind::text, .expected = "ray, or a block of pixels, like block:8x8"},
      [](Params& p, const base::Scalar& value) { return set_task(p.block, value); },
      [](const Params& p) -> base::Scalar {
        return p.block ? fmt::format("block:{}x{}", p.block->width, p.block->height) : "ray";
      }};
}

base::Field<Params> seed_field() {
  auto field = programs::seed_field<Params>(&Params::seed, "seed of the order of the cells");
  field.domain.high = 0x1p63;
  field.domain.expected = fmt::format("a whole number from 0 to {}", INT64_MAX);
  return field;
}

base::Fields<Params> memory_fields() {
  using D = base::Declare<Params>;
  constexpr double MOST = 0x1p40;
  return {D::whole("worker_memory_bytes", &Params::worker_memory, 1, MOST, "bytes",
                   "memory of a worker and of the coordinator; else the model's"),
          D::whole("database_memory_bytes", &Params::database_memory, 1, MOST, "bytes",
                   "memory of the ray database and of the display; else the model's")};
}

// `member` of P holds them.
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
                    "order of cells of one size; adaptive: where objects meet first"),
          D::choice("cells", &Params::cells, LIGHTS,
                    "what a sample shows of its cell: constant colour, one point, or a smooth "
                    "transition to its neighbours"),
          D::choice("preview", &Params::preview, preview_names(),
                    "picture that the display draws itself before the first ray, by z-buffer"),
          weights_field<Params>(&Params::weights,
                                "what a ray's influence, level and cell weigh in its priority; "
                                "[0, 0, 0]: they are compared one after the other")};
}

bool set_show_at(Params& p, const base::Scalar& value) {
  const auto& times = std::get<std::vector<double>>(value);
  if (!std::ranges::all_of(times, [](double t) { return t >= 0 && t <= 1e9; })) return false;
  if (std::ranges::adjacent_find(times, std::greater_equal<>()) != times.end()) return false;
  p.looks.at_s = times;
  return true;
}

base::Fields<Params> look_fields() {
  using D = base::Declare<Params>;
  const auto every = [](Params & p) -> auto& { return p.looks.every_s; };
  const auto growth = [](Params & p) -> auto& { return p.looks.growth; };
  return {{"show_at_s",
           "s",
           "pictures at these times, counted as time_s",
           {.kind = base::Domain::Kind::list,
            .expected = "times in s, 0 or more, each after the one before"},
           &set_show_at,
           [](const Params& p) -> base::Scalar { return p.looks.at_s; }},
          D::number("show_every_s", every, 0, 1e9, "s",
                    "and at each multiple of this, a thousand times at most; 0: at none"),
          D::whole("growth", growth, 0, 1000, "",
                   "times, at least, at which the picture is compared with the last one, for "
                   "growth.csv and the moving picture; 0: never")};
}

base::Fields<Params> farm_fields() {
  using D = base::Declare<Params>;
  return {task_field(),
          D::whole("scene_message_bytes", &Params::scene_message, 0, 1 << 24, "bytes",
                   "longest message that sends the scene to the workers, in setup_s; 0: they have "
                   "it"),
          seed_field()};
}

base::Fields<ProgramParams> scene_fields() {
  using D = base::Declare<ProgramParams>;
  return {
      D::source("scene.source", &ProgramParams::scene,
                "spheres, as many as scene.objects; spheres:200 or hills:20000; or an NFF file"),
      D::whole("scene.objects", &ProgramParams::objects, 1, 1e9, "",
               "spheres in a generated scene")};
}

base::Fields<SharedParams> data_fields() {
  using D = base::Declare<SharedParams>;
  static const base::Names<shared_memory::Scheme> SCHEMES = {
      {"items", shared_memory::Scheme::items}, {"pages", shared_memory::Scheme::pages}};
  auto methods = programs::METHODS;
  std::erase(methods, std::pair(std::string("naive"), network::Method::naive));
  return {
      D::number("cache_percent", &SharedParams::cache_percent, 0, 100, "%",
                "cache of a worker, share of the scene's bytes; 0: it holds the scene"),
      D::number("server_cache_percent", &SharedParams::server_cache_percent, 0, 100, "%",
                "cache of the coordinator, share of the scene's bytes, with items"),
      D::choice("scheme", &SharedParams::scheme, SCHEMES,
                "items, cached on the way to the coordinator; or pages, spread over the workers"),
      D::flag("in_path", &SharedParams::in_path, "true: requests are offered to all on the way"),
      D::flag("waiting_queue", &SharedParams::waiting_queue,
              "true: a processor that waits for an item shares it with those that ask for it"),
      D::whole("page_items", &SharedParams::page_items, 1, 1e6, "", "items in a page"),
      D::choice("method", &SharedParams::method, methods,
                "how routers avoid deadlock: green, chalmers or acyclic")};
}

base::Fields<ProgramParams> make_fields() {
  using P = ProgramParams;
  const auto image = [](P & p) -> auto& { return p.farm.image; };
  const auto data = [](P & p) -> auto& { return p.data ? *p.data : p.data.emplace(); };
  return base::join(base::lift_all<P>(memory_fields(), &P::farm, "machine."),
                    {scene_fields(), base::lift_all<P>(renderer::param_fields(), image, "image."),
                     base::lift_all<P>(cell_fields(), &P::farm, "farm."),
                     base::lift_all<P>(farm_fields(), &P::farm, "farm."),
                     base::lift_all<P>(look_fields(), &P::farm, "farm."),
                     base::lift_all<P>(data_fields(), data, "data.")});
}

base::Fields<Limits> limit_fields() {
  using D = base::Declare<Limits>;
  return {
      D::number("min_influence", &Limits::min_influence, 0, 1, "", "influence factor, at least"),
      D::whole("depth_reflected", &Limits::depth_reflected, 0, 1000, "",
               "tree level, at most, of rays with only reflections before them"),
      D::whole("depth_transmitted", &Limits::depth_transmitted, 0, 1000, "",
               "tree level, at most, of transmitted rays and their descendants"),
      D::whole("min_cell", &Limits::min_cell, 1, 65536, "pixels",
               "size of the image cell, at least"),
      base::lift<Limits>(renderer::area_field(), &Limits::area),
      weights_field<Limits>(&Limits::weights, "as farm.weights, while these limits are set")};
}

// `append` puts a record behind the others in the list.
template <class Record, class List, class Append>
programs::RecordList make_list(const std::string& key, const std::string& help,
                               const base::Fields<Record>& fields, List Params::*list,
                               Append append) {
  const auto find = [list](std::any& params) -> List& {
    return std::any_cast<ProgramParams&>(params).farm.*list;
  };
  const auto record = [](std::any& any) -> Record& { return std::any_cast<Record&>(any); };
  return {key,
          help,
          base::lift_all<std::any>(fields, record),
          [] { return std::any(Record{}); },
          [find](std::any& params) { find(params).clear(); },
          [find, append](std::any& params, const std::any& any) {
            find(params).push_back(append(std::any_cast<const Record&>(any)));
          }};
}

struct OrderRecord {
  double at_s = 0;
  bool non_interactive = false, interactive = false, abort = false;
  std::string save;
  std::optional<Limits> limits;  // where any is given
};

Order make_order(const OrderRecord& record) {
  std::vector<Command> commands;
  if (record.limits) commands.push_back({*record.limits});
  if (record.non_interactive) commands.push_back({NonInteractive{}});
  if (record.interactive) commands.push_back({Interactive{}});
  if (record.abort) commands.push_back({Abort{}});
  if (!record.save.empty()) commands.push_back({Save{record.save}});
  if (commands.size() != 1)
    throw base::BadInput(
        fmt::format("[[order]] at {} s: found {}, expected one of: limits, non_interactive = true, "
                    "interactive = true, abort = true, save = \"name\"",
                    record.at_s, commands.empty() ? "nothing to do" : "several things to do"));
  return {{record.at_s}, commands[0]};
}

bool is_picture_name(const std::string& name) {
  return !name.empty() && name.size() <= 40 &&
         std::ranges::all_of(name, [](unsigned char c) { return std::isalnum(c) || c == '-'; });
}

base::Field<OrderRecord> save_field() {
  return {"save",
          "",
          "the picture as it is then is saved, with this in its name",
          {.kind = base::Domain::Kind::text, .expected = "up to 40 letters, digits and dashes"},
          [](OrderRecord& r, const base::Scalar& value) {
            const auto& name = std::get<std::string>(value);
            if (!is_picture_name(name)) return false;
            r.save = name;
            return true;
          },
          [](const OrderRecord& r) -> base::Scalar { return r.save; }};
}

base::Fields<OrderRecord> order_fields() {
  using D = base::Declare<OrderRecord>;
  const auto limits = [](OrderRecord & r) -> auto& {
    return r.limits ? *r.limits : r.limits.emplace();
  };
  return base::join(
      base::Fields<OrderRecord>{
          D::number("at_s", &OrderRecord::at_s, 0, 1e9, "s",
                    "when the user orders it, counted as time_s from the first task"),
          D::flag("non_interactive", &OrderRecord::non_interactive,
                  "true: the user leaves the interactive phase"),
          D::flag("interactive", &OrderRecord::interactive,
                  "true: the user comes back from the non-interactive phase"),
          D::flag("abort", &OrderRecord::abort,
                  "true: the user has had enough; rays that are under way end"),
          save_field()},
      {base::lift_all<OrderRecord>(limit_fields(), limits)});
}

std::vector<programs::RecordList> make_lists() {
  return {make_list("stage", "limits of the interactive phase, one set after the other",
                    limit_fields(), &Params::stages, [](const Limits& limits) { return limits; }),
          make_list("order", "what the user orders, at_s seconds after the first task",
                    order_fields(), &Params::script, &make_order)};
}

// Whether the scene says its size itself, so that `objects` is void.
bool has_own_objects(const ProgramParams& params) { return params.scene.text != "spheres"; }

// What the image of a run depends on: runs of equal keys have equal images.
std::string image_key(const ProgramParams& params) {
  const auto& p = params.farm.image;
  return fmt::format("{} {}x{} {} {} {} {} {} {},{},{},{}", scene_source(params), p.width, p.height,
                     p.limits.depth, p.limits.min_influence, int(p.feelers), int(p.sample),
                     p.ambient, p.area.x, p.area.y, p.area.width, p.area.height);
}

// Kept for each source: the points of a sweep share a few scenes.
SceneSize size_of_scene(const std::string& source) {
  static std::map<std::string, SceneSize> sizes;
  const auto known = sizes.find(source);
  if (known != sizes.end()) return known->second;
  return sizes[source] = size_of(renderer::load_scene(source));
}

// Generated spheres stand on a floor that is not counted.
programs::Row describe(const ProgramParams& params) {
  const auto source = scene_source(params);
  const auto all = static_cast<std::int64_t>(size_of_scene(source).objects);
  return {{"objects", source.starts_with("spheres:") ? all - 1 : all}};
}

Params make_params(const Setup& setup, const ProgramParams& params) {
  Params farm = params.farm;
  farm.cycles_per_host_s = setup.cycles_per_host_s;
  farm.profile = setup.profile;
  farm.processes = setup.processes;
  farm.watch = setup.watch;
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
  const SceneSize size = size_of_scene(scene_source(params));
  if (shares_data(params)) check(setup.model, size, make_params(setup, params), *params.data);
}

programs::Image make_image(const ProgramParams& params, const std::string& name,
                           std::optional<double> at_s, std::vector<std::uint8_t> rgb8) {
  const auto kept = std::make_shared<const std::vector<std::uint8_t>>(std::move(rgb8));
  const int width = params.farm.image.width, height = params.farm.image.height;
  return {.name = name,
          .at_s = at_s,
          .save = [=](const std::string& path) { renderer::save_png(path, width, height, *kept); },
          .is_named = true};
}

// "spheres-200": letters, digits and dashes.
std::string picture_name(const ProgramParams& params) {
  std::string name = std::filesystem::path(scene_source(params)).filename().string();
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '-';
  return name;
}

std::vector<programs::Image> make_images(const ProgramParams& params, const Result& result) {
  const auto name = picture_name(params);
  std::vector<programs::Image> images;
  const auto add = [&](const std::string& suffix, std::optional<double> at_s, const auto& rgb8) {
    images.push_back(make_image(params, name + suffix, at_s, rgb8));
  };
  add("", result.is_aborted ? std::optional(result.time_s) : std::nullopt, result.rgb8);
  for (const auto& key : result.key_images)
    add("-" + key.name, std::max(0.0, key.at.value - result.setup_s), key.rgb8);
  for (std::size_t i = 0; i < result.pictures.size(); ++i)
    add(fmt::format("-shown{}", i + 1), result.pictures[i].at_s, result.pictures[i].rgb8);
  if (!result.growth.empty())
    images.push_back(growth::make_movie(name + "-growth", result.growth, params.farm.image.width));
  return images;
}

SharedResult run_one(const Setup& setup, const ProgramParams& params) {
  const auto scene = renderer::load_scene(scene_source(params));
  const Params farm = make_params(setup, params);
  if (shares_data(params))
    return run_shared_farm(setup.model, setup.topology, scene, farm, *params.data);
  SharedResult result;
  result.farm = run_farm(setup.model, setup.topology, scene, farm);
  return result;
}

Outcome<Measured> run(const Setup& setup, const ProgramParams& params) {
  Measured measured(run_one(setup, params), params.data.has_value(), shares_data(params));
  Result& result = measured.run.farm;
  Outcome<Measured> outcome;
  if (!result.growth.empty()) {
    const auto& image = params.farm.image;
    auto grown = growth::make_growth(result.growth, image.width, params.farm.max_cell);
    outcome.growth = std::move(grown.rows);
    measured.growth = grown.figures;
  }
  outcome.images = make_images(params, result);
  outcome.end = result.end;
  outcome.use = result.use;
  outcome.loads = measured.loads;
  outcome.events = result.events;
  outcome.notes = std::move(result.notes);
  if (setup.cycles_per_host_s) {
    for (auto& note : kernels::note_short(result.kernels)) outcome.notes.push_back(std::move(note));
    outcome.kernels = std::move(result.kernels);
  }
  if (setup.profile && !measured.is_shared) outcome.kernel_host_s = result.kernel_host_s;
  outcome.rows.push_back(std::move(measured));
  return outcome;
}

}  // namespace

programs::Program make_farm() {
  auto program = programs::make_program<ProgramParams, Measured>(
      {.name = "farm",
       .help = "the farm of chapter 4: a ray tracer with increasing realism",
       .uses = {.network = true, .timed = true},
       .fields = make_fields(),
       .columns = make_columns(),
       .run = &run,
       .check = &check_program,
       .describe = &describe,
       .lists = make_lists()});
  program.processors = "workers";
  program.shows_parameters = false;
  program.leading = {"topology", "workers", "objects"};
  program.picture_key = [](const std::any& params) {
    return image_key(std::any_cast<const ProgramParams&>(params));
  };
  program.voids = [](const std::any& params, const std::string& key) -> std::string {
    const bool is_void =
        key == "scene.objects" && has_own_objects(std::any_cast<const ProgramParams&>(params));
    return is_void ? "scene.source" : "";
  };
  return program;
}

std::string scene_source(const ProgramParams& params) {
  if (!has_own_objects(params)) return fmt::format("spheres:{}", params.objects);
  return params.scene.path.empty() ? params.scene.text : params.scene.path;
}

}  // namespace farm

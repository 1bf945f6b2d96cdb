#include "simulator/iirra/program.hpp"

#include "renderer/files/load_scene.hpp"
#include "simulator/iirra/measured.hpp"
#include "simulator/programs/declare/support.hpp"
#include "simulator/ray_tracing/snapshot_fields.hpp"

namespace iirra {

using programs::Outcome;
using programs::Setup;

namespace {

constexpr double Weights::*WEIGHTS[] = {&Weights::position, &Weights::size,  &Weights::samples,
                                        &Weights::contrast, &Weights::depth, &Weights::influence};

// Declares a field for the weights of P in `member`.
template <class P, class Member>
base::Field<P> weights_field(Member member, const std::string& help) {
  const auto set = [member](P& p, const base::Scalar& value) {
    const auto& given = std::get<std::vector<double>>(value);
    const auto is_weight = [](double w) { return w >= 0 && w <= 1e6; };
    if (given.size() != std::size(WEIGHTS) || !std::ranges::all_of(given, is_weight)) return false;
    Weights weights;
    for (std::size_t i = 0; i < given.size(); ++i) weights.*WEIGHTS[i] = given[i];
    p.*member = weights;
    return true;
  };
  const auto get = [member](const P& p) -> base::Scalar {
    const std::optional<Weights> weights = p.*member;
    if (!weights) return {};
    std::vector<double> all;
    for (const auto weight : WEIGHTS) all.push_back((*weights).*weight);
    return all;
  };
  return {"weights",
          "",
          help,
          {.kind = base::Domain::Kind::list,
           .expected = "[position, size, samples, contrast, depth, influence], six numbers from 0 "
                       "to 1e6"},
          set,
          get};
}

base::Fields<Params> cell_fields() {
  using D = base::Declare<Params>;
  static const base::Names<CellOrder> ORDERS = {{"bayer", CellOrder::bayer},
                                                {"random", CellOrder::random},
                                                {"sequential", CellOrder::sequential},
                                                {"recursive", CellOrder::recursive},
                                                {"adaptive", CellOrder::adaptive}};
  return {D::whole("cell", &Params::max_cell, 2, MAX_CELL, "pixels",
                   "side of the first cells, a power of two"),
          D::choice("order", &Params::order, ORDERS,
                    "order of cells of equal importance; adaptive: the greatest contrast first"),
          weights_field<Params>(&Params::weights,
                                "weights of position, size, samples, contrast, depth and influence "
                                "in a cell's importance"),
          programs::whole_seed_field<Params>(&Params::seed, "seed for the order of the cells")};
}

base::Fields<Params> machine_fields() {
  using D = base::Declare<Params>;
  static const base::Names<Start> STARTS = {{"scattered", Start::scattered},
                                            {"blocks", Start::blocks},
                                            {"subsampled", Start::subsampled}};
  static const base::Names<BalanceMethod> METHODS = {{"none", BalanceMethod::none},
                                                     {"neighbours", BalanceMethod::neighbours},
                                                     {"coordinator", BalanceMethod::coordinator},
                                                     {"active", BalanceMethod::active},
                                                     {"mixed", BalanceMethod::mixed},
                                                     {"green", BalanceMethod::green},
                                                     {"ring", BalanceMethod::ring}};
  return {
      D::choice("start", &Params::start, STARTS,
                "initial distribution of cells: scattered over macro-cells, a block for each "
                "worker, or balanced by the measured time of one sample per cell"),
      D::choice("balance", &Params::balance, METHODS,
                "how workers share tasks during the run: request from neighbours; request on the "
                "path to the coordinator; send unasked (active); both (mixed); down a tree "
                "(green); request around a ring"),
      D::whole("reserve", &Params::reserve, 1, 1000, "",
               "number of tasks that a worker keeps; with fewer it requests more"),
      D::choice("display", &Params::is_far, base::Names<bool>{{"far", true}, {"near", false}},
                "processor of the display: the farthest from the coordinator, or a neighbour"),
      D::choice("node", &Params::is_double, base::Names<bool>{{"single", false}, {"double", true}},
                "processors of a worker: one; or two that share a memory, one of them for the data "
                "manager and the router"),
      D::choice("refresh", &Params::is_polled, base::Names<bool>{{"polled", true}, {"sent", false}},
                "polled: the display requests each worker's part of the picture; sent: workers "
                "send every change"),
      D::whole("polls_at_once", &Params::polls, 1, 1000, "",
               "largest number of pending requests of the display; 1: one worker after the other"),
      D::flag("borders", &Params::has_borders,
              "true: save each picture also with the borders of its cells"),
      D::number("frame_s", &Params::frame_s, 0, 1000, "s",
                "time of a frame on the screen: shortest time between two requests to a worker"),
      D::whole("buffers", &Params::buffers, 1, 1e6, "",
               "messages that a router has room for; default: the number of processors plus 64")};
}

base::Fields<ProgramParams> make_fields() {
  using P = ProgramParams;
  using D = base::Declare<P>;
  const auto image = [](auto& p) -> auto& { return p.iirra.image; };
  const auto snapshot_times = [](auto& p) -> auto& { return p.iirra.snapshot_times; };
  const auto memory = [](auto& p) -> auto& { return p.iirra.memory; };
  return base::join(
      base::Fields<P>{D::whole("machine.worker_memory_bytes", memory, 1, 0x1p40, "bytes",
                               "memory of a worker; default: the model's")},
      {base::lift_all<P>(ray_tracing::scene_fields(), &P::scene),
       base::lift_all<P>(renderer::param_fields(), image, "image."),
       base::lift_all<P>(cell_fields(), &P::iirra, "iirra."),
       base::lift_all<P>(machine_fields(), &P::iirra, "iirra."),
       base::lift_all<P>(ray_tracing::snapshot_fields(), snapshot_times, "iirra."),
       // In the last place, so that the key "order" without a section means iirra.order instead of
       // image.order.
       base::lift_all<P>(base::Fields<Params>{ray_tracing::pixel_order_field(&Params::pixels)},
                         &P::iirra, "image."),
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
      D::whole("min_cell", &Limits::min_cell, 1, MAX_CELL, "pixels", "smallest side of a cell"),
      D::whole("max_samples", &Limits::max_samples, 5, 13, "",
               "largest number of samples of a cell"),
      D::number("min_contrast", &Limits::min_contrast, 0, 1, "",
                "smallest contrast of cells to divide (Eq 4.7)"),
      base::lift<Limits>(renderer::area_field(), &Limits::area),
      weights_field<Limits>(&Limits::weights, "replaces iirra.weights while these limits apply")};
}

bool shares_data(const ProgramParams& params) {
  return params.data && params.data->cache_percent > 0;
}

Params make_params(const Setup& setup, const ProgramParams& params) {
  Params iirra = params.iirra;
  iirra.faults = setup.faults;
  iirra.others = setup.others;
  iirra.cycles_per_host_s = setup.cycles_per_host_s;
  iirra.engine = setup.engine;
  iirra.monitor = setup.monitor;
  if (params.data) iirra.method = params.data->method;
  if (shares_data(params))
    iirra.data = make_data_params(setup.model, size_of(params.scene), *params.data);
  return iirra;
}

void check_program(const Setup& setup, const ProgramParams& params) {
  if (shares_data(params)) check_data(setup.model, size_of(params.scene), *params.data);
  const Params iirra = make_params(setup, params);
  base::require(iirra.method != network::Method::acyclic || !setup.tree, "network.tree",
                "found a tree for all senders, expected none with data.method = \"acyclic\", which "
                "has its own");
  check(iirra, setup.topology);
}

Outcome<Measured> run(const Setup& setup, const ProgramParams& params) {
  const auto scene = renderer::load_scene(scene_source(params.scene));
  auto result = run_iirra(setup.model, setup.topology, setup.routes, setup.tree, scene,
                          make_params(setup, params));
  const ray_tracing::DataFigures data{params.data.has_value(), result.shared};
  Measured measured(std::move(result), data);
  auto given =
      make_given(setup, params.scene, params.iirra.image, params.iirra.max_cell, measured.run);
  measured.growth = given.growth;
  Outcome<Measured> outcome;
  static_cast<programs::Extras&>(outcome) = std::move(given.extras);
  outcome.loads = measured.loads;
  outcome.rows.push_back(std::move(measured));
  return outcome;
}

}  // namespace

programs::Program make_iirra() {
  using P = ProgramParams;
  auto program = programs::make_program<P, Measured>(
      {.name = "iirra",
       .help = "chapter 5's ray tracer: image cells and task managers on every processor",
       .uses = {.network = true, .routes = true, .faults = true, .timed = true, .others = true},
       .fields = make_fields(),
       .columns = make_columns(),
       .run = &run,
       .check = &check_program,
       .describe = [](const P& params) { return ray_tracing::describe(params.scene); },
       .lists = ray_tracing::make_lists<P>(
           limit_fields(), [](auto& p) -> auto& { return p.iirra.stages; },
           [](auto& p) -> auto& { return p.iirra.script; })});
  program.processors = "workers";
  program.services = SERVICES;
  program.shows_parameters = false;
  program.shows.leading = {"topology", "workers", "objects"};
  program.shows_picture = true;
  program.picture_key = [](const std::any& any) {
    const auto& params = std::any_cast<const P&>(any);
    return picture_key(params.scene, params.iirra.image);
  };
  program.voids = [](const std::any& params, const std::string& key) {
    return find_void(std::any_cast<const P&>(params).scene, key);
  };
  return program;
}

}  // namespace iirra

#include "simulator/iirra/program.hpp"

#include "renderer/files/load_scene.hpp"
#include "simulator/iirra/measured.hpp"

namespace iirra {

using programs::Outcome;
using programs::Setup;

namespace {

constexpr double Weights::*WEIGHTS[] = {&Weights::position, &Weights::size,  &Weights::samples,
                                        &Weights::contrast, &Weights::depth, &Weights::influence};

constexpr auto WEIGHTS_EXPECTED =
    "[position, size, samples, contrast, depth, influence], six numbers from 0 to 1e6";

base::Fields<Params> memory_fields() {
  return {base::Declare<Params>::whole("worker_memory_bytes", &Params::memory, 1, 0x1p40, "bytes",
                                       "memory of a worker; default: the model's")};
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
          ray_tracing::weights_field<Params>(
              WEIGHTS, &Params::weights, WEIGHTS_EXPECTED,
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

base::Fields<Limits> limit_fields() {
  using D = base::Declare<Limits>;
  return base::join(
      ray_tracing::ray_limit_fields<Limits>(),
      {{D::whole("min_cell", &Limits::min_cell, 1, MAX_CELL, "pixels", "smallest side of a cell"),
        D::whole("max_samples", &Limits::max_samples, 5, 13, "",
                 "largest number of samples of a cell"),
        D::number("min_contrast", &Limits::min_contrast, 0, 1, "",
                  "smallest contrast of cells to divide (Eq 4.7)"),
        base::lift<Limits>(renderer::area_field(), &Limits::area),
        ray_tracing::weights_field<Limits>(WEIGHTS, &Limits::weights, WEIGHTS_EXPECTED,
                                           "replaces iirra.weights while these limits apply")}});
}

Params make_params(const Setup& setup, const ProgramParams& params) {
  Params iirra = params.machine;
  if (params.data) iirra.method = params.data->method;
  if (params.shares_data())
    iirra.data = make_data_params(setup.model, size_of(params.scene), *params.data);
  return iirra;
}

void check_program(const Setup& setup, const ProgramParams& params) {
  if (params.shares_data()) check_data(setup.model, size_of(params.scene), *params.data);
  const Params iirra = make_params(setup, params);
  base::require(iirra.method != network::Method::acyclic || !setup.tree, "network.tree",
                "found a tree for all senders, expected none with data.method = \"acyclic\", which "
                "has its own");
  check(iirra, setup.topology);
}

Outcome<Measured> run(const Setup& setup, const ProgramParams& params) {
  const auto scene = renderer::load_scene(scene_source(params.scene));
  auto result = run_iirra(setup, scene, make_params(setup, params));
  const ray_tracing::DataFigures data{params.data.has_value(), result.shared};
  return make_outcome(setup, params, Measured(std::move(result), data));
}

}  // namespace

programs::Program make_iirra() {
  auto program = ray_tracing::make_program<Limits, Params, Measured>(
      {.name = "iirra",
       .help = "chapter 5's ray tracer: image cells and task managers on every processor",
       .uses = {.network = true, .routes = true, .faults = true, .timed = true, .others = true},
       .fields = ray_tracing::program_fields("iirra", memory_fields(),
                                             base::join(cell_fields(), {machine_fields()})),
       .columns = make_columns(),
       .run = &run,
       .check = &check_program},
      limit_fields());
  program.services = SERVICES;
  return program;
}

}  // namespace iirra

#include "simulator/radiosity/program.hpp"

#include "renderer/radiosity/show/fields.hpp"
#include "simulator/declare/routers.hpp"
#include "simulator/radiosity/measured.hpp"

namespace amp {

using programs::Outcome;
using programs::Setup;

namespace {

base::Fields<Params> machine_fields() {
  using D = base::Declare<Params>;
  static const base::Names<Distribution> DISTRIBUTIONS = {{"tiles", Distribution::tiles},
                                                          {"blocks", Distribution::blocks},
                                                          {"work", Distribution::work}};
  static const base::Names<bool> BORDERS = {{"exchanged", true}, {"repeated", false}};
  return {D::choice("distribution", &Params::distribution, DISTRIBUTIONS,
                    "which processor has which patches: of every face an equal share; equal counts "
                    "of consecutive ones; consecutive ones of equal estimated work"),
          D::choice("borders", &Params::exchange, BORDERS,
                    "vertices between processors: found by one, that tells the others, or by each"),
          D::choice("method", &Params::method, programs::METHODS,
                    "how routers avoid deadlock; acyclic takes the network's routes only if they "
                    "close no cycle"),
          D::whole("show_every", &Params::show_every, 0, 1e9, "",
                   "shots between two pictures on the way; 0: none"),
          D::number("cache_percent", &Params::cache_percent, 0, 100, "%",
                    "share of the geometry that a processor's data manager has room for; 0: all "
                    "have all of it")};
}

base::Fields<ProgramParams> make_fields() {
  using P = ProgramParams;
  using D = base::Declare<P>;
  const auto of_room = [](const base::Fields<RoomParams>& fields) {
    return base::lift_all<P>(fields, &P::room);
  };
  const auto reconstruction = base::lift_all<RoomParams>(
      base::select(radiosity::reconstruction_fields(), {"reconstruction"}),
      &RoomParams::reconstruction);
  return base::join(
      of_room(solution_fields()),
      {base::lift_all<P>(machine_fields(), &P::machine),
       of_room(reconstruction),
       of_room(view_fields()),
       of_room(reference_fields()),
       {D::number("amplify", &P::amplify, 0, 1e6, "", "factor of the difference image"),
        D::number("peak_from", &P::peak_from, 0, 1, "",
                  "share of the width from which the line's largest value is looked for"),
        D::number("peak_to", &P::peak_to, 0, 1, "", "share of the width up to which it is")}});
}

Params machine_params(const Setup& setup, const ProgramParams& params) {
  Params machine = params.machine;
  machine.solve = params.room.light.solve;
  machine.cycles_per_host_s = setup.cycles_per_host_s;
  machine.watch = setup.watch;
  return machine;
}

Outcome<Measured> run(const Setup& setup, const ProgramParams& params) {
  const auto room = load_scene(params.room);
  const auto mesh = make_mesh(room, params.room.light.mesh);
  auto result = run_radiosity(setup.model, setup.topology, mesh, machine_params(setup, params));
  if (result.end != machine::End::done)
    throw programs::Unfinished(
        "machine", {result.total_s},
        fmt::format("the run was ended at {:.6f} s ({})", result.total_s, to_string(result.end)));
  auto [shown, images] = show(params, room.view, mesh, result.frames);
  const bool has_data = params.machine.cache_percent > 0;
  const auto note = describe_loss(result.loss, has_data);
  Outcome<Measured> outcome(Measured{mesh.patches.size(), mesh.vertices.size(), std::move(result),
                                     has_data, std::move(shown)});
  outcome.notes = {note};
  outcome.images = std::move(images);
  return outcome;
}

void check_program(const Setup&, const ProgramParams& params) {
  check(params.room);
  if (params.peak_from >= params.peak_to)
    throw base::BadInput(fmt::format("program.peak_to: found {}, expected above peak_from, {}",
                                     params.peak_to, params.peak_from));
}

}  // namespace

programs::Program make_radiosity() {
  return programs::make_program<ProgramParams, Measured>(
      {.name = "radiosity",
       .help =
           "progressive radiosity as in AMP: the brightest patch is found by a reduction, sent to "
           "all, and received where the patches are; pictures of it",
       .uses = {.network = true, .timed = true},
       .fields = make_fields(),
       .columns = make_columns(),
       .run = &run,
       .check = &check_program});
}

}  // namespace amp

#include "simulator/parallel_radiosity/program.hpp"

#include "renderer/radiosity/show/adapt.hpp"
#include "renderer/radiosity/show/display.hpp"
#include "simulator/observe/mean.hpp"
#include "simulator/parallel_radiosity/pictures.hpp"
#include "simulator/programs/declare/routers.hpp"
#include "simulator/snapshots/quality_curve.hpp"

namespace parallel_radiosity {

using programs::Outcome;
using programs::Setup;

using base::column;
using base::Columns;

namespace {

base::Fields<Params> machine_fields() {
  using D = base::Declare<Params>;
  static const base::Names<Distribution> DISTRIBUTIONS = {{"tiles", Distribution::tiles},
                                                          {"blocks", Distribution::blocks},
                                                          {"work", Distribution::work}};
  static const base::Names<bool> BORDERS = {{"exchanged", true}, {"repeated", false}};
  return {D::choice("distribution", &Params::distribution, DISTRIBUTIONS,
                    "distribution of patches over processors: an equal share of every face "
                    "(tiles); equal numbers of consecutive patches (blocks); consecutive patches "
                    "of equal estimated work (work)"),
          D::choice("borders", &Params::exchange, BORDERS,
                    "vertices on borders between processors: computed by one and sent to the "
                    "others, or computed by each"),
          D::choice("method", &Params::method, programs::METHODS,
                    "how routers avoid deadlock; acyclic uses the network's routes if they have no "
                    "cycle, else its own"),
          D::whole("show_every", &Params::show_every, 0, 1e9, "",
                   "shots between two intermediate pictures; 0: none"),
          D::number("cache_percent", &Params::cache_percent, 0, 100, "%",
                    "share of the geometry that a data manager's cache has room for; 0: every "
                    "processor has the whole geometry")};
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
       {D::number("amplify", &P::amplify, 0, 1e6, "",
                  "factor that multiplies the difference image"),
        D::number("peak_from", &P::peak_from, 0, 1, "",
                  "left end of the range in which the line's largest value is "
                  "searched, as a share of the width"),
        D::number("peak_to", &P::peak_to, 0, 1, "",
                  "right end of the range from peak_from, as a share of the width")}});
}

struct Measured {
  std::size_t patches = 0, vertices = 0, left_out = 0;
  Result result;
  bool has_data = false;  // true if data managers hold the geometry
  PictureSummary shown;
};

// Mean load of all CPUs; not a number if no time passed.
double eval_cpu_mean(const observe::Use& use) {
  double busy = 0;
  for (const auto& cpu : use.cpus)
    busy += cpu.busy_s / use.time_s / static_cast<double>(use.cpus.size());
  return busy;
}

std::uint64_t find_memory(const observe::Use& use) {
  std::uint64_t memory = 0;
  for (const auto& cpu : use.cpus) memory = std::max(memory, cpu.memory_peak_bytes);
  return memory;
}

std::uint64_t count_rays(const Result& result) {
  return result.work[renderer::Op::ray_intersected];
}

Columns<Measured> size_columns() {
  using M = Measured;
  return {
      column<M>(
          "time_s", [](const M& m) { return m.result.time_s; },
          "time until every processor has finished the last shot"),
      base::empty_column<M>("speedup", "time_s on one processor over time_s"),
      base::empty_column<M>("efficiency", "speedup over processors"),
      column("patches", &M::patches, "patches of the mesh"),
      column("vertices", &M::vertices, "vertices of the mesh"),
      column("creases_left_out", &M::left_out, "creases left out of the mesh, at least in part"),
      column<M>(
          "shots", [](const M& m) { return m.result.shots; },
          "shots: number of times that a patch sent its light"),
      column<M>(
          "unshot",
          [](const M& m) { return m.result.frames.empty() ? 1 : m.result.frames.back().unshot; },
          "share of the emitted power that is still unsent"),
      column<M>(
          "total_s", [](const M& m) { return m.result.total_s; },
          "time until the display has the last picture")};
}

Columns<Loss> loss_columns() {
  return {
      column("useful", &Loss::useful, "share of the processors' time in kernels"),
      column("repeated", &Loss::repeated, "share spent on vertices that two processors compute"),
      column("unequal", &Loss::unequal,
             "share spent waiting for the processor with the most work in a shot"),
      column("messages", &Loss::messages, "share spent on messages and everything else")};
}

Columns<Result> work_columns() {
  using R = Result;
  return {column<R>("rays", &count_rays, "rays cast"),
          column<R>(
              "rays_per_s",
              [](const R& r) {
                return observe::eval_mean(static_cast<double>(count_rays(r)), r.time_s);
              },
              "rays over time_s"),
          column("vertices_max", &R::vertices_done_max,
                 "largest number of vertices that a processor computes in a shot"),
          column("kernel_cycles", &R::kernel_cycles, "cycles charged for kernels")};
}

Columns<observe::Use> load_columns() {
  using U = observe::Use;
  return {observe::message_columns()[0],
          column<U>("message_bytes", &observe::total_bytes, "bytes of these messages"),
          observe::link_busy_column(),
          column<U>("cpu_busy_mean", &eval_cpu_mean, "share of time_s, mean of the processors"),
          column<U>("memory_bytes", &find_memory, "largest memory that a processor used")};
}

Columns<Measured> picture_columns() {
  using E = radiosity::PictureError;
  const auto has_reference = [](const Measured& m) { return m.shown.error.has_value(); };
  const auto error = [](const Measured& m) -> auto& { return *m.shown.error; };
  const auto of_shown = [](const Columns<PictureSummary>& columns) {
    return base::lift_columns<Measured>(columns, &Measured::shown);
  };
  const Columns<E> errors = {
      column("image_error", &E::image,
             "root mean square of the difference over that of the reference"),
      column("line_error", &E::line, "image_error for the displayed red of the central line"),
      column("peak_error", &E::line_peak,
             "difference of the largest values on the central line, over the reference's"),
      column("line_error_linear", &E::line_linear,
             "line_error for radiosity instead of displayed values"),
      column("peak_error_linear", &E::line_peak_linear,
             "peak_error for radiosity instead of displayed values"),
      column("peak_shift", &E::peak_shift,
             "pixels from the reference's largest value to the picture's")};
  return base::join(
      of_shown({column("radiosity_mean", &PictureSummary::radiosity_mean,
                       "mean radiosity, weighted by area")}),
      {base::only_if(has_reference,
                     of_shown({column("reference_mean", &PictureSummary::reference_mean,
                                      "mean radiosity of the reference")})),
       of_shown({column("exposure_used", &PictureSummary::exposure, "exposure of the pictures")}),
       base::only_if(has_reference, base::lift_columns<Measured>(errors, error))});
}

// Columns for sizes, times, losses, loads and pictures. The columns about data managers are empty
// if the run has no data managers. The columns about the reference are empty if the run has none.
Columns<Measured> make_columns() {
  const auto data = [](const Measured& m) -> auto& { return m.result.data; };
  const auto loss = [](const Measured& m) -> auto& { return m.result.loss; };
  const auto use = [](const Measured& m) -> auto& { return m.result.use; };
  return base::join(size_columns(),
                    {base::lift_columns<Measured>(loss_columns(), loss),
                     base::lift_columns<Measured>(work_columns(), &Measured::result),
                     base::lift_columns<Measured>(load_columns(), use),
                     base::only_if(&Measured::has_data, base::lift_columns<Measured>(
                                                            shared_memory::data_columns(), data)),
                     picture_columns()});
}

// Makes a sentence such as "81.0 % of the time is useful; the largest loss: 9.0 % waiting for ...".
std::string describe_loss(const Loss& loss, bool has_data) {
  const std::pair<double, const char*> losses[] = {
      {loss.repeated, "computing vertices that another processor also computes"},
      {loss.unequal, "waiting for the processor with the most work in a shot"},
      {loss.messages, has_data ? "accesses of data managers, and messages"
                               : "messages, including the search for the brightest patch"}};
  if (loss.useful > 0.9995) return "all of the time is useful";
  const auto [share, what] =
      *std::ranges::max_element(losses, {}, [](const auto& of) { return of.first; });
  return fmt::format("{:.1f} % of the time is useful; the largest loss: {:.1f} % {}",
                     100 * loss.useful, 100 * share, what);
}

Params machine_params(const Setup& setup, const ProgramParams& params, const renderer::View& view,
                      const radiosity::Mesh& mesh) {
  Params machine = params.machine;
  machine.solve = params.room.light.solve;
  if (setup.cycles_per_host_s)
    machine.draw = [&](const Frame& frame) { draw(params, view, mesh, frame); };
  if (observe::is_observed(setup.monitor))
    machine.look = [&](const Frame* frame) { return look(params, view, mesh, frame); };
  return machine;
}

Outcome<Measured> run(const Setup& setup, const ProgramParams& params) {
  const auto room = load_scene(params.room);
  const auto mesh = make_lit_mesh(room, params.room.light).mesh;
  auto result = run_radiosity(setup, mesh, machine_params(setup, params, room.view, mesh));
  if (result.end != machine::End::done)
    throw programs::Unfinished(
        "machine", {result.total_s},
        fmt::format("the run ended early at {:.6f} s ({})", result.total_s, to_string(result.end)));
  auto shown = show(params, room.view, mesh, result.frames);
  const bool has_data = params.machine.cache_percent > 0;
  const auto note = describe_loss(result.loss, has_data);
  auto kernels = std::move(result.kernels);
  Outcome<Measured> outcome(Measured{mesh.patches.size(), mesh.vertices.size(), mesh.left_out,
                                     std::move(result), has_data, shown.summary});
  outcome.notes = {note};
  for (auto& sentence : kernels::note_short(kernels)) outcome.notes.push_back(std::move(sentence));
  outcome.kernels = std::move(kernels);
  outcome.images = std::move(shown.images);
  outcome.growth = snapshots::make_quality_curve(shown.previews, shown.width, 1).rows;
  return outcome;
}

void check_program(const Setup&, const ProgramParams& params) {
  check(params.room);
  if (params.peak_from >= params.peak_to)
    base::refuse("program.peak_to", "found {}, expected more than peak_from, {}", params.peak_to,
                 params.peak_from);
}

}  // namespace

programs::Program make_radiosity() {
  auto program = programs::make_program<ProgramParams, Measured>(
      {.name = "radiosity",
       .help = "progressive radiosity as in AMP: a reduction finds the brightest patch, every "
               "processor receives it and lights its own patches; renders pictures",
       .uses = {.network = true, .timed = true, .others = true},
       .fields = make_fields(),
       .columns = make_columns(),
       .run = &run,
       .check = &check_program});
  program.shows_picture = true;
  return program;
}

}  // namespace parallel_radiosity

#include "simulator/radiosity/measured.hpp"

#include <fmt/format.h>

#include "simulator/observe/columns.hpp"
#include "simulator/shared_memory/columns.hpp"

namespace amp {

using base::column;
using base::Columns;

namespace {

double over(double part, double all) { return all > 0 ? part / all : 0; }

double eval_cpu_mean(const observe::Use& use) {
  double busy = 0;
  for (const auto& cpu : use.cpus)
    busy += over(cpu.busy_s, use.time_s) / static_cast<double>(use.cpus.size());
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
          "until the last shot is done everywhere"),
      base::empty_column<M>("speedup", "time_s on one processor over time_s"),
      base::empty_column<M>("efficiency", "speedup over processors"),
      column("patches", &M::patches, "patches of the mesh"),
      column("vertices", &M::vertices, "vertices of the mesh"),
      column<M>(
          "shots", [](const M& m) { return m.result.shots; }, "times a patch sent its light"),
      column<M>(
          "unshot",
          [](const M& m) { return m.result.frames.empty() ? 1 : m.result.frames.back().unshot; },
          "share of the emitted power that is not sent"),
      column<M>(
          "total_s", [](const M& m) { return m.result.total_s; },
          "until the display has the last picture")};
}

Columns<Loss> loss_columns() {
  return {column("useful", &Loss::useful, "share of the processors' time in kernels"),
          column("repeated", &Loss::repeated, "share spent on vertices that are found twice"),
          column("unequal", &Loss::unequal,
                 "share spent waiting for the processor with most to do in a shot"),
          column("messages", &Loss::messages, "share of messages and all else")};
}

Columns<Result> work_columns() {
  using R = Result;
  return {column<R>("rays", &count_rays, "rays cast"),
          column<R>(
              "rays_per_s",
              [](const R& r) { return over(static_cast<double>(count_rays(r)), r.time_s); },
              "rays over time_s"),
          column("vertices_max", &R::vertices_done_max,
                 "vertices that a processor finds in a shot, at most"),
          column("kernel_cycles", &R::kernel_cycles, "cycles that kernels were charged")};
}

Columns<observe::Use> load_columns() {
  using U = observe::Use;
  return {observe::message_columns()[0],
          column<U>("message_bytes", &observe::total_bytes, "bytes of these messages"),
          observe::link_busy_column(),
          column<U>("cpu_busy_mean", &eval_cpu_mean, "share of time_s, mean of the processors"),
          column<U>("memory_bytes", &find_memory, "the most memory that a processor used")};
}

Columns<Measured> picture_columns() {
  using E = radiosity::PictureError;
  const auto has_reference = [](const Measured& m) { return m.shown.error.has_value(); };
  const auto error = [](const Measured& m) -> auto& { return *m.shown.error; };
  const auto of_shown = [](const Columns<PictureSummary>& columns) {
    return base::lift_columns<Measured>(columns, &Measured::shown);
  };
  const Columns<E> errors = {
      column("image_error", &E::image, "root mean square of the difference over the reference's"),
      column("line_error", &E::line, "the same of the central line's displayed red"),
      column("peak_error", &E::line_peak,
             "difference of that line's largest values, over the reference's"),
      column("line_error_linear", &E::line_linear, "line_error of the radiosity"),
      column("peak_error_linear", &E::line_peak_linear, "peak_error of the radiosity"),
      column("peak_shift", &E::peak_shift,
             "pixels from the reference's largest value to the picture's")};
  return base::join(
      of_shown(
          {column("radiosity_mean", &PictureSummary::radiosity_mean, "mean radiosity by area")}),
      {base::only_if(has_reference,
                     of_shown({column("reference_mean", &PictureSummary::reference_mean,
                                      "mean radiosity of the reference")})),
       of_shown({column("exposure_used", &PictureSummary::exposure, "exposure of the pictures")}),
       base::only_if(has_reference, base::lift_columns<Measured>(errors, error))});
}

}  // namespace

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

std::string describe_loss(const Loss& loss, bool has_data) {
  const std::pair<double, const char*> losses[] = {
      {loss.repeated, "finding vertices that another processor finds too"},
      {loss.unequal, "waiting for the processor with most to do in a shot"},
      {loss.messages, has_data ? "data managers' accesses, and messages"
                               : "finding the brightest patch and telling others: messages"}};
  if (loss.useful > 0.9995) return "all of the time is useful";
  const auto [share, what] =
      *std::ranges::max_element(losses, {}, [](const auto& of) { return of.first; });
  return fmt::format("{:.1f} % of the time is useful; the largest loss: {:.1f} % {}",
                     100 * loss.useful, 100 * share, what);
}

}  // namespace amp

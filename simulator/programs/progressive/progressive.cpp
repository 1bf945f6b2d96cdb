// The sequential ray tracer that refines its image step by step (thesis, 4.2), on a single
// processor.
#include "renderer/progressive/progressive.hpp"

#include "renderer/files/load_scene.hpp"
#include "simulator/kernels/kernels.hpp"
#include "simulator/programs/declare/support.hpp"
#include "simulator/snapshots/quality_curve.hpp"

namespace programs {

namespace progressive {

using renderer::progressive::Progressive;
using renderer::progressive::Step;
using renderer::progressive::StepCounts;

struct Params {
  base::Source scene{"room:27", ""};
  renderer::Params image;
  Step step;  // the last step; its depth and area come from `image`
  int max_cell = 16;
  renderer::progressive::StepKind kind = renderer::progressive::StepKind::cells;
};

struct Measured {
  int number = 0;
  Step step;
  StepCounts counts;
  Seconds time{};
};

Step last_step(const Params& params) {
  Step last = params.step;
  last.depth = params.image.limits.depth;
  last.area = params.image.area;
  return last;
}

Image make_picture(const Params& params, const Step& step, Seconds time,
                   const Progressive& progressive) {
  const auto name = params.kind == renderer::progressive::StepKind::cells
                        ? fmt::format("cell-{}", step.min_cell)
                        : fmt::format("level-{}", step.depth);
  return {.name = name,
          .at_s = time.value,
          .save = [picture = progressive.make_picture()](const std::string& path) {
            renderer::save_png(path, picture);
          }};
}

Outcome<Measured> run(const Setup& setup, const Params& params) {
  const auto& [text, path] = params.scene;
  const auto scene = renderer::load_scene(path.empty() ? text : path);
  const auto costs = kernels::tree_costs(setup.model);
  Machine machine(setup, 1);
  Outcome<Measured> outcome;
  std::vector<snapshots::Snapshot> shown;
  std::uint64_t rays = 0, cycles = 0;
  machine[0].start("renderer", Priority::low, [&] {
    Progressive progressive(scene, params.image, params.max_cell);
    for (const Step& step : make_steps(params.kind, params.max_cell, last_step(params))) {
      const auto counts = progressive.advance(step);
      // If a level of the shading trees adds no rays, deeper levels cannot add any.
      if (params.kind == renderer::progressive::StepKind::depth && counts.rays.fresh.total() == 0)
        break;
      const auto cost = costs(counts.rays.work.counts);
      compute(cost);
      const int number = static_cast<int>(outcome.rows.size()) + 1;
      outcome.rows.push_back({number, step, counts, now()});
      outcome.images.push_back(make_picture(params, step, now(), progressive));
      rays += counts.rays.fresh.total() + counts.rays.repeated;
      cycles += static_cast<std::uint64_t>(cost.value);
      shown.push_back({now().value, rays, cycles, make_rgb8(progressive.make_picture())});
    }
  });
  run_machine(setup, machine);
  outcome.growth = snapshots::make_quality_curve(shown, params.image.width, params.max_cell).rows;
  return outcome;
}

base::Fields<Params> make_fields() {
  using D = base::Declare<Params>;
  return base::join<base::Field<Params>>(
      {D::source("scene", &Params::scene, "room:27, spheres:200, hills:20000 or an NFF file"),
       renderer::progressive::step_kind_field<Params>(&Params::kind),
       renderer::progressive::max_cell_field<Params>(&Params::max_cell)},
      {base::lift_all<Params>(renderer::progressive::step_fields(), &Params::step),
       base::lift_all<Params>(renderer::param_fields(), &Params::image)});
}

base::Columns<Measured> make_columns() {
  using M = Measured;
  const auto count = [](const char* name, std::uint64_t StepCounts::*member, const char* help) {
    return column<M>(
        name, [member](const M& m) { return m.counts.*member; }, help);
  };
  const auto rays = [](const char* name, std::uint64_t renderer::RayCounts::*member,
                       const char* help) {
    return column<M>(
        name, [member](const M& m) { return m.counts.rays.fresh.*member; }, help);
  };
  return {
      column("step", &M::number, "number of the step, from 1"),
      column<M>(
          "cell", [](const M& m) { return m.step.min_cell; },
          "side of the smallest cells of the step, in pixels"),
      column<M>(
          "level", [](const M& m) { return m.step.depth; },
          "levels of the shading trees in the step"),
      column("time_s", &M::time, "time at the end of the step, for tracing rays only"),
      count("samples", &StepCounts::samples, "new samples"),
      count("deepened", &StepCounts::deepened, "samples whose shading trees were deepened"),
      column<M>(
          "new_rays", [](const M& m) { return m.counts.rays.fresh.total(); },
          "rays that the samples of the step needed"),
      rays("new_reflected", &renderer::RayCounts::reflected, "reflected rays among new_rays"),
      rays("new_transmitted", &renderer::RayCounts::transmitted, "transmitted rays among new_rays"),
      column<M>(
          "repeated_rays", [](const M& m) { return m.counts.rays.repeated; },
          "rays traced again to reach the new levels"),
      column<M>(
          "repeated_percent",
          [](const M& m) { return renderer::progressive::get_repeated_percent(m.counts.rays); },
          "repeated_rays over new_rays, in percent"),
      count("cells", &StepCounts::cells, "cells of the image after the step"),
      count("divided_by_contrast", &StepCounts::by_contrast,
            "cells divided because of their contrast"),
      count("divided_by_pyramid", &StepCounts::by_pyramid,
            "cells divided because they may hide an object")};
}

void check_program(const Setup&, const Params& params) {
  if (params.image.sampling.pixel_samples > 1)
    base::refuse("pixel_samples", "found {}, expected 1 (each cell has one sample)",
                 params.image.sampling.pixel_samples);
  renderer::progressive::check(last_step(params), params.image, params.max_cell);
}

}  // namespace progressive

Program make_progressive() {
  using namespace progressive;
  return make_program<Params, Measured>(
      {.name = "progressive",
       .help = "the sequential ray tracer with increasing realism on one processor",
       .fields = make_fields(),
       .columns = make_columns(),
       .parts = {"step"},
       .run = &run,
       .check = &check_program});
}

}  // namespace programs

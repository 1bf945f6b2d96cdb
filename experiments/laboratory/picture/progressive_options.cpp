#include "experiments/laboratory/picture/progressive_options.hpp"

#include <filesystem>

#include "base/whole_file.hpp"
#include "experiments/laboratory/host/jobs.hpp"
#include "experiments/laboratory/host/progress.hpp"
#include "experiments/laboratory/options/options.hpp"
#include "experiments/laboratory/setup/open_scene.hpp"
#include "renderer/progressive/progressive.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;
using renderer::progressive::Progressive, renderer::progressive::Step;
using renderer::progressive::StepCounts, renderer::progressive::StepKind;
using renderer::progressive::TreeRays;
using Json = nlohmann::ordered_json;

Json make_step_json(const Step& step, const StepCounts& counts) {
  return {{"min_cell", step.min_cell},
          {"depth", step.depth},
          {"samples", counts.samples},
          {"deepened", counts.deepened},
          {"cells", counts.cells},
          {"divided_by_contrast", counts.by_contrast},
          {"divided_by_pyramid", counts.by_pyramid},
          {"pyramid_boxes", counts.boxes},
          {"rays", make_json(counts.rays.fresh)},
          {"repeated_rays", counts.rays.repeated},
          {"repeated_percent", get_repeated_percent(counts.rays)},
          {"work", make_json(counts.rays.work)}};
}

void save_stats(const RenderTask& task, const TreeRays& all, Json steps, double seconds) {
  const auto traced = static_cast<double>(all.fresh.total() + all.repeated);
  const Json stats = {{"scene", task.scene},
                      {"width", task.params.width},
                      {"height", task.params.height},
                      {"rays", make_json(all.fresh)},
                      {"repeated_rays", all.repeated},
                      {"steps", std::move(steps)},
                      {"work", make_json(all.work)},
                      {"seconds", seconds},
                      {"rays_per_second", traced / seconds}};
  base::save_whole(task.stats, stats.dump(2) + "\n");
}

std::string name_of(StepKind kind, const Step& step) {
  return kind == StepKind::cells ? fmt::format("cell-{}", step.min_cell)
                                 : fmt::format("depth-{}", step.depth);
}

Step make_last_step(const ProgressiveOptions& o, const renderer::Params& params) {
  Step last = o.last;
  last.pyramid = !o.no_pyramid;
  last.depth = params.limits.depth;
  last.area = params.area;
  check(last, params, o.max_cell);
  return last;
}

}  // namespace

void add_progressive_options(CLI::App& command, ProgressiveOptions& o) {
  auto* progressive = command.add_flag("--progressive", o.is_wanted,
                                       "render in steps and refine cells where the image needs it; "
                                       "outside --area the first cells remain");
  bind_options(
      command,
      {renderer::progressive::step_kind_field<ProgressiveOptions>(&ProgressiveOptions::kind),
       renderer::progressive::max_cell_field<ProgressiveOptions>(&ProgressiveOptions::max_cell)},
      o);
  bind_options(command,
               base::select(renderer::progressive::step_fields(), {"min_cell", "contrast"}),
               o.last);
  command.add_flag("--no-pyramid", o.no_pyramid,
                   "divide cells by contrast only, even if they may hide an object");
  for (const char* name : {"--steps", "--max-cell", "--min-cell", "--contrast", "--no-pyramid"})
    command.get_option(name)->needs(progressive);
}

void render_progressively(const ProgressiveOptions& o, const RenderTask& task) {
  const Step last = make_last_step(o, task.params);
  const auto scene = open_scene(task.scene);
  check_can_save_all({task.output, task.stats});
  if (!task.key_images.empty()) make_folder("--key-images", task.key_images);
  const auto steps = make_steps(o.kind, o.max_cell, last);
  const InterruptGuard guard;  // delays interrupts until all files are written
  Progress bar("rendering");
  Clock clock;
  double seconds = 0;
  Progressive image(scene, task.params, o.max_cell, task.threads);
  std::optional<renderer::Samples> picture;
  TreeRays all;
  Json rows = Json::array();
  bool is_stopped = false;
  for (const Step& step : steps) {
    const auto counts = image.advance(step, was_interrupted);
    seconds += clock.lap();
    if (!counts) is_stopped = true;
    // Ends early if a depth adds no rays: then deeper levels of the shading trees add none either.
    if (!counts || (o.kind == StepKind::depth && counts->rays.fresh.total() == 0)) break;
    all += counts->rays;
    rows.push_back(make_step_json(step, *counts));
    picture = image.make_picture();
    if (!task.key_images.empty())
      save_image((fs::path(task.key_images) / (name_of(o.kind, step) + extension_of(task.encoding)))
                     .string(),
                 *picture, task.encoding);
    clock.lap();
    bar.show(rows.size(), steps.size());
  }
  if (!picture) throw Interrupted();
  const auto done = rows.size();
  save_image(task.output, *picture, task.encoding);
  if (!task.stats.empty()) save_stats(task, all, std::move(rows), seconds);
  if (is_stopped)
    throw Failure(fmt::format("interrupted; {} has the picture after {} of {} steps", task.output,
                              done, steps.size()),
                  EXIT_INTERRUPTED);
}

}  // namespace laboratory

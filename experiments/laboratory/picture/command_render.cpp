#include <fmt/format.h>

#include "base/whole_file.hpp"
#include "experiments/laboratory/host/jobs.hpp"
#include "experiments/laboratory/host/progress.hpp"
#include "experiments/laboratory/options/options.hpp"
#include "experiments/laboratory/picture/picture_commands.hpp"
#include "experiments/laboratory/picture/progressive_options.hpp"
#include "experiments/laboratory/picture/render_frames.hpp"
#include "experiments/laboratory/picture/render_preview.hpp"
#include "experiments/laboratory/picture/render_refined.hpp"
#include "experiments/laboratory/setup/open_scene.hpp"
#include "renderer/trace/params.hpp"
#include "renderer/trace/render.hpp"
#include "renderer/trace/sampling.hpp"

namespace laboratory {
namespace {

using Endings = std::vector<std::string>;

struct RenderOptions : RenderTask {
  std::string size, area;
  std::optional<renderer::PreviewStep> preview;
  ProgressiveOptions progressive;
  RefinedOptions refined;
  FramesOptions frames;
  std::string samples_map;
};

// Writes the file of --stats: the number of rays, the host time in seconds, and the members of
// `more`.
void save_stats(const RenderOptions& o, const renderer::Rendering& image, std::uint64_t rays,
                double seconds, const nlohmann::ordered_json& more) {
  nlohmann::ordered_json stats = {{"scene", o.scene},
                                  {"width", o.params.width},
                                  {"height", o.params.height},
                                  {"rays", make_json(image.rays)},
                                  {"work", make_json(image.work)}};
  stats.update(more);
  stats["seconds"] = seconds;
  stats["rays_per_second"] = static_cast<double>(rays) / seconds;
  base::save_whole(o.stats, stats.dump(2) + "\n");
}

void save_files(const RenderOptions& o, const renderer::Rendering& image) {
  save_image(o.output, image.samples, o.encoding);
  if (!o.samples_map.empty())
    renderer::save_png(o.samples_map, o.params.width, o.params.height,
                       renderer::make_count_map(image.counts));
}

void check_samples_map(const RenderOptions& o) {
  if (!is_adaptive(o.params.sampling))
    throw CLI::ValidationError("--samples-map",
                               fmt::format("expected --adaptive above 0 and --pixel-samples above "
                                           "{}: otherwise all pixels have equal counts",
                                           renderer::FIRST_ROUND));
  check_apart("--samples-map", o.samples_map, {o.output, o.stats});
  base::check_can_save(o.samples_map);
}

void render_at_once(const RenderOptions& o) {
  const auto scene = open_scene(o.scene);
  check_can_save_all({o.output, o.stats, o.samples_map});
  const InterruptGuard guard;  // delays interrupts until all files are written
  Progress bar("rendering");
  Clock clock;
  int rows_done = 0, all_rows = 0;
  const auto image = renderer::render(scene, o.params, o.threads, [&](int done, int rows) {
    bar.show(static_cast<std::size_t>(done), static_cast<std::size_t>(rows));
    rows_done = done, all_rows = rows;
    return !was_interrupted();
  });
  const double seconds = clock.lap();
  const bool is_whole = rows_done == all_rows;
  auto more = nlohmann::ordered_json::object();
  if (!is_whole) more = {{"rows", all_rows}, {"rows_done", rows_done}};
  save_files(o, image);
  if (!o.stats.empty()) save_stats(o, image, image.rays.total(), seconds, more);
  if (!is_whole)
    throw Failure(fmt::format("interrupted; {} has the picture after {} of {} rows", o.output,
                              rows_done, all_rows),
                  EXIT_INTERRUPTED);
}

void render_in_order(const RenderOptions& o) {
  const auto scene = open_scene(o.scene);
  check_can_save_all({o.output, o.stats, o.samples_map});
  const InterruptGuard guard;  // delays interrupts until all files are written
  Clock clock;
  const auto refined = render_refined(o.refined, o, scene);
  const double seconds = clock.lap();
  save_files(o, refined.image);
  if (!o.stats.empty())
    save_stats(o, refined.image, refined.rays, seconds,
               {{"samples", refined.all},
                {"samples_done", refined.done},
                {"queue_peak", refined.queue_peak}});
  if (refined.interrupted) report_interrupt(o.refined, o, refined);
}

void render_scene(RenderOptions& o) {
  parse_size(o.size, o.params);
  if (!o.area.empty()) {
    const auto v = parse_numbers<4>("--area", o.area, "X,Y,WxH, such as 10,20,64x48");
    o.params.area = {v[0], v[1], v[2], v[3]};
    if (v[2] <= 0 || v[3] <= 0)
      throw CLI::ValidationError(
          "--area", fmt::format("found \"{}\", expected a width and a height above 0", o.area));
  }
  const bool has_frames = !o.frames.frames.empty();
  check_output(o.output, has_frames ? Endings{".png", ".exr", ".webp"} : Endings{".png", ".exr"},
               o.stats);
  if (!o.samples_map.empty()) check_samples_map(o);
  check_apart("--state", o.refined.state, {o.output, o.stats, o.samples_map});
  check_apart("--resume", o.refined.resume, {o.output, o.stats, o.samples_map});

  renderer::check(o.params);
  if (o.preview) return save_preview(o, *o.preview);
  if (o.progressive.is_wanted) return render_progressively(o.progressive, o);
  if (has_frames) return render_frames(o.frames, o);
  if (o.refined.are_wanted()) return render_in_order(o);
  if (!o.key_images.empty())
    throw CLI::ValidationError("--key-images",
                               "expected --progressive or --order with this option");
  render_at_once(o);
}

}  // namespace

void add_render_command(CLI::App& app) {
  auto* command = app.add_subcommand("render", "render a scene with the sequential renderer");
  auto o = std::make_shared<RenderOptions>();
  // Uses the traversal `nearest`, which is faster than the thesis's traversal and yields the same
  // image. Experiments use the thesis's, because they count its work.
  o->params.traversal = renderer::Traversal::nearest;

  command
      ->add_option("SCENE", o->scene,
                   "an .nff or .obj file, spheres:N, hills:N (triangles) or room:L (lights)")
      ->required();
  command->add_option("-o,--output", o->output, "the image to write, .png or .exr")
      ->check(check_file_name)
      ->required();
  add_encoding_options(*command, o->encoding);
  command->add_option("--size", o->size, "WxH in pixels [100x100]");
  bind_options(*command,
               base::select(renderer::param_fields(),
                            {"depth", "min_influence", "feelers", "total_reflection", "sample",
                             "traversal", "ambient"}),
               o->params, {{"min_influence", "influence"}});
  bind_options(*command, renderer::sampling_fields(), o->params);
  command
      ->add_option("--samples-map", o->samples_map,
                   "PNG file for a map of the samples per pixel, on a logarithmic scale from 1 "
                   "(black) to the maximum (white)")
      ->check(check_file_name);
  command->add_option("--area", o->area, "area of interest, X,Y,WxH in pixels [whole image]");
  add_progressive_options(*command, o->progressive);
  bind_options<RenderTask>(*command,
                           {base::Declare<RenderTask>::whole("threads", &RenderTask::threads, 1,
                                                             1024, "", "host threads")},
                           *o);
  command->add_option("--stats", o->stats, "write counts of rays and work to this JSON file")
      ->check(check_file_name);
  add_preview_option(*command, o->preview);
  add_refined_options(*command, o->refined);
  command
      ->add_option("--key-images", o->key_images,
                   "folder for intermediate pictures: after each step of --progressive, or with "
                   "--order after 1, 5, 25 and 100 % of the samples")
      ->check(check_folder_name);
  add_frames_options(*command, o->frames);
  for (const char* one_sample : {"--progressive", "--preview"})
    for (const char* name : {"--pixel-samples", "--adaptive", "--samples-map"})
      command->get_option(name)->excludes(command->get_option(one_sample));
  command->footer(
      "Examples:\n  tlab render spheres:800 -o spheres.png --size 640x480\n  tlab render "
      "experiments/scenes/still-life.nff -o still-life.png");
  command->callback([o, command] {
    fit_encoding(*command, o->output, o->encoding);
    render_scene(*o);
  });
}

}  // namespace laboratory

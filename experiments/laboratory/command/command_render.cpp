#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "experiments/laboratory/command/command_options.hpp"
#include "experiments/laboratory/command/commands.hpp"
#include "experiments/laboratory/host/files.hpp"
#include "experiments/laboratory/host/progress.hpp"
#include "experiments/laboratory/points/work_json.hpp"
#include "renderer/files/load.hpp"
#include "renderer/trace/render.hpp"

namespace laboratory {

namespace {

struct Options {
  std::string scene, output, stats, size, area;
  renderer::Params params;
  int threads = 1;
};

void save_stats(const Options& o, const renderer::Rendering& image, double seconds) {
  const auto& rays = image.rays;
  const nlohmann::ordered_json stats = {
      {"scene", o.scene},
      {"width", o.params.width},
      {"height", o.params.height},
      {"rays",
       {{"primary", rays.primary},
        {"primary_hit", rays.primary_hit},
        {"reflected", rays.reflected},
        {"transmitted", rays.transmitted},
        {"shadow", rays.shadow},
        {"total", rays.total()}}},
      {"work", make_json(image.work)},
      {"seconds", seconds},
      {"rays_per_second", static_cast<double>(rays.total()) / seconds}};
  write_file(o.stats, stats.dump(2) + "\n");
}

void render_scene(Options& o) {
  parse_size(o.size, o.params);
  if (!o.area.empty()) {
    const auto v = parse_numbers<4>("--area", o.area, "X,Y,WxH, such as 10,20,64x48");
    o.params.area = {v[0], v[1], v[2], v[3]};
    if (v[2] <= 0 || v[3] <= 0)
      throw CLI::ValidationError("--area", fmt::format("found \"{}\", expected a width and a "
                                                       "height above zero",
                                                       o.area));
  }
  if (const auto ending = std::filesystem::path(o.output).extension();
      !ending.empty() && ending != ".png")
    throw CLI::ValidationError(
        "--output", fmt::format("found \"{}\", expected a name that ends in .png", o.output));
  if (o.stats == o.output)
    throw CLI::ValidationError("--stats", "expected another file than the image's");
  renderer::check(o.params);
  const auto scene = renderer::load_scene(o.scene);
  Progress bar("rendering");
  const auto start = std::chrono::steady_clock::now();
  const auto image = renderer::render(scene, o.params, o.threads, [&](int done, int rows) {
    bar.show(static_cast<std::size_t>(done), static_cast<std::size_t>(rows));
  });
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  renderer::save_png(o.output, image.samples);
  if (!o.stats.empty()) save_stats(o, image, seconds);
}

}  // namespace

void add_render_command(CLI::App& app) {
  auto* command = app.add_subcommand("render", "render a scene with the sequential renderer");
  auto o = std::make_shared<Options>();
  o->params.traversal = renderer::Traversal::nearest;
  command->add_option("SCENE", o->scene, "an NFF file, or spheres:N")->required();
  command->add_option("-o,--output", o->output, "the PNG image to write")->required();
  command->add_option("--size", o->size, "WxH in pixels [100x100]");
  command->add_option("--depth", o->params.limits.depth, "levels of the shading tree, 1 to 1000")
      ->capture_default_str();
  command
      ->add_option("--influence", o->params.limits.min_influence,
                   "no ray is made below this influence factor, 0 to 1")
      ->capture_default_str();
  add_choice(command, "--feelers", o->params.feelers, FEELERS,
             "a shadow feeler to all lights, or to those in front");
  add_choice(command, "--sample", o->params.sample, SAMPLES,
             "where in its pixel; lattice spans edge to edge");
  add_choice(command, "--traversal", o->params.traversal, TRAVERSALS,
             "of the hierarchy: same image, other work");
  command->add_option("--ambient", o->params.ambient, "intensity of ambient light")
      ->capture_default_str();
  command->add_option("--area", o->area, "area of interest, X,Y,WxH in pixels [whole image]");
  command->add_option("--threads", o->threads, "host threads")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->add_option("--stats", o->stats, "write counts of rays and work to this JSON file");
  command->callback([o] { render_scene(*o); });
}

}  // namespace laboratory

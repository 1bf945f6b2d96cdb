#include <fmt/format.h>

#include <filesystem>

#include "base/text.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/host/progress.hpp"
#include "experiments/laboratory/host/streams.hpp"
#include "experiments/laboratory/options/options.hpp"
#include "experiments/laboratory/picture/image_encoding.hpp"
#include "experiments/laboratory/picture/picture_commands.hpp"
#include "experiments/laboratory/setup/open_scene.hpp"
#include "renderer/radiosity/creases/creases.hpp"
#include "renderer/radiosity/light/solve.hpp"
#include "renderer/radiosity/show/adapt.hpp"
#include "renderer/radiosity/show/display.hpp"
#include "renderer/radiosity/show/orientation.hpp"

namespace laboratory {
namespace {

using radiosity::Mesh;
using radiosity::Picture;
using renderer::Rgb;
using renderer::Work;

struct RadiosityOptions {
  std::string room, output, stats, size, exposure = "auto";
  radiosity::Creases creases = radiosity::Creases::file;
  radiosity::LightParams light;
  radiosity::ReconstructionParams reconstruction;
  radiosity::PictureParams picture;
  radiosity::Display display;
  radiosity::AdaptParams adapt;
  bool preview = false, asks_display = false;  // asks_display: --exposure or --gamma was given
};

bool is_exr(const RadiosityOptions& o) {
  return std::filesystem::path(o.output).extension() == ".exr";
}

void check_files(const RadiosityOptions& o) {
  check_output(o.output, {".png", ".exr"}, o.stats);
  check_exr(o.output, o.asks_display);
}

// Parses the value of --exposure. 0 means automatic.
double parse_exposure(const std::string& text) {
  if (text == "auto") return 0;
  const auto value = base::parse_number<double>(text);
  require_option(value && *value > 0 && *value < 1e300, "--exposure",
                 "found \"{}\", expected auto, or a number above 0", text);
  return *value;
}

struct Outcome {
  int rounds = 0;
  double error = 0;  // estimated error of the picture (see radiosity::estimate_error)
  std::size_t patches = 0, vertices = 0, mirrors = 0, creases = 0, left_out = 0;
  radiosity::Solution solution;
  Rgb emitted;  // power that the room emits
  bool is_closed = false;
  Picture picture;
  Work picture_work;
  double mesh_s = 0, solve_s = 0, picture_s = 0;
};

// Makes a function that shows the progress of all solutions of the radiosity equation on one bar.
radiosity::Step make_step(const RadiosityOptions& o, Progress& bar) {
  // The bar is logarithmic in the energy not yet distributed, because each step distributes a
  // similar share of it.
  const double end = std::log(std::max(o.light.solve.tolerance, 1e-9));
  return [&o, &bar, end](int shots, double unshot) {
    const double by_light = end < 0 ? std::log(std::max(unshot, 1e-9)) / end : 1;
    const double by_shots = o.light.solve.shots > 0 ? 1.0 * shots / o.light.solve.shots : 1;
    bar.show(static_cast<std::size_t>(1000 * std::clamp(std::max(by_light, by_shots), 0.0, 1.0)),
             1000);
    return true;
  };
}

// Makes the picture of the illuminated room. Chooses the exposure unless the user has set it.
void draw(RadiosityOptions& o, const Mesh& mesh, const renderer::View& view, Outcome& made) {
  std::vector<Rgb> values = made.solution.vertices;
  if (o.light.ambient) add_ambient(mesh, made.solution.ambient, values);
  const auto illumination = radiosity::reconstruct(mesh, values, o.reconstruction);
  made.picture = o.preview ? preview_picture(mesh, illumination, view, o.picture)
                           : trace_picture(mesh, illumination, view, o.picture, made.picture_work);
  if (!is_exr(o) && o.display.exposure == 0)
    o.display = fit(o.display, made.picture, find_emitters(mesh, view, o.picture));
}

Outcome light(RadiosityOptions& o) {
  Outcome made;
  Clock clock;
  auto room = open_room(o.room);
  check_can_save_all({o.output, o.stats});
  choose_creases(room, o.creases);
  o.picture = fit(o.picture, room.view);
  Progress bar("radiosity");
  const auto step = make_step(o, bar);
  radiosity::AdaptedMesh adapted =
      o.adapt.error > 0 ? radiosity::adapt_mesh(room, o.light, o.reconstruction, o.adapt, step)
                        : radiosity::make_lit_mesh(room, o.light, step);
  const Mesh& mesh = adapted.mesh;
  made.rounds = adapted.rounds;
  made.error = adapted.error;
  made.patches = mesh.patches.size();
  made.vertices = mesh.vertices.size();
  made.mirrors = mesh.mirrors.size();
  made.creases = room.creases.size();
  made.left_out = mesh.left_out;
  for (const auto& problem : radiosity::find_turned_faces(room, mesh))
    bar.say(fmt::format("tlab: warning: {}: {}", o.room, problem));
  made.mesh_s = clock.lap();

  made.solution = solve_adapted(room, adapted, o.light, step);
  if (o.adapt.error == 0 && o.light.senders == 0)
    made.error =
        radiosity::estimate_error(mesh, made.solution, o.light.solve, o.reconstruction, room.view);
  made.emitted = mesh.emitted;
  made.is_closed = radiosity::is_closed(mesh);
  made.solve_s = clock.lap();

  draw(o, mesh, room.view, made);
  made.picture_s = clock.lap();
  return made;
}

void save_stats(const RadiosityOptions& o, const Outcome& made) {
  const radiosity::Balance& balance = made.solution.balance;
  const auto rays = static_cast<double>(made.solution.work[renderer::Op::ray_intersected]);
  nlohmann::ordered_json stats = {
      {"scene", o.room},
      {"patches", made.patches},
      {"vertices", made.vertices},
      {"mirrors", made.mirrors},
      {"rounds", made.rounds},
      {"estimated_error", made.error},
      {"creases", made.creases},
      {"creases_left_out", made.left_out},
      {"shots", made.solution.shots},
      {"unshot", made.solution.unshot},
      {"emitted", {made.emitted.r, made.emitted.g, made.emitted.b}},
      {"balance",
       {{"reflected", balance.reflected},
        {"absorbed", balance.absorbed},
        {"unsent", balance.unsent},
        {"escaped", balance.escaped},
        {"backs", balance.backs},
        {"closed", made.is_closed}}},
      {"ambient", {made.solution.ambient.r, made.solution.ambient.g, made.solution.ambient.b}},
      {"work", make_json(made.solution.work)},
      {"width", made.picture.width},
      {"height", made.picture.height},
      {"picture_work", make_json(made.picture_work)},
      {"seconds", {{"mesh", made.mesh_s}, {"solution", made.solve_s}, {"picture", made.picture_s}}},
      {"rays_per_second", rays / made.solve_s}};
  if (!is_exr(o)) stats["exposure"] = o.display.exposure, stats["gamma"] = o.display.gamma;
  base::save_whole(o.stats, stats.dump(2) + "\n");
}

// A warning appears if more than this share of the emitted power is lost in a closed room.
constexpr double FAIR_BALANCE = 0.01;

void print_balance(const Outcome& made) {
  const auto& [reflected, absorbed, unsent, escaped, backs] = made.solution.balance;
  const double lost = escaped - backs;
  const auto where = made.is_closed ? fmt::format("{:.2f} % on backs of faces, {:.2f} % lost",
                                                  100 * backs, 100 * lost)
                                    : fmt::format("{:.2f} % escaped or in mirrors", 100 * escaped);
  print_out(
      "of the emitted power {:.2f} % absorbed, {:.2f} % unsent, {}; {:.2f} % reflected (counted at "
      "every reflection)\n",
      100 * absorbed, 100 * unsent, where, 100 * reflected);
  const double error = made.is_closed ? lost : std::min(escaped, 0.0);
  if (std::abs(error) > FAIR_BALANCE)
    complain(
        fmt::format("warning: {:.1f} % of the light is {}: use more patches (--refine) or smaller "
                    "delta areas (--spread)",
                    100 * std::abs(error), error > 0 ? "lost" : "too much"));
}

// A warning appears if the estimated relative error of the picture is larger than this.
constexpr double FAIR_ERROR = 0.02;

void warn_of_error(const RadiosityOptions& o, const Outcome& made) {
  const bool follows = o.adapt.error == 0 && o.creases == radiosity::Creases::found;
  if (follows && made.error > FAIR_ERROR)
    complain(
        fmt::format("warning: patches are too coarse for the light: the estimated error of the "
                    "picture between vertices is {:.2g} %; use more patches (--refine, --adaptive)",
                    100 * made.error));
  if (o.adapt.error > 0 && made.error > o.adapt.error)
    complain(
        fmt::format("warning: patches were halved {} times, but the estimated error is {:.2g} % "
                    "instead of {:.2g} %",
                    made.rounds, 100 * made.error, 100 * o.adapt.error));
}

void run(RadiosityOptions& o) {
  check_files(o);
  parse_size(o.size, o.picture);
  o.display.exposure = parse_exposure(o.exposure);
  radiosity::check(o.picture);
  const Outcome made = light(o);
  if (is_exr(o))
    renderer::save_exr(o.output, made.picture);
  else
    radiosity::save_png(o.output, made.picture, o.display);
  if (!o.stats.empty()) save_stats(o, made);
  print_out("{} patches, {} vertices, {} shots, {:.3g} % unshot", made.patches, made.vertices,
            made.solution.shots, 100 * made.solution.unshot);
  if (o.adapt.error > 0)
    print_out(", halved {} times to an error of about {:.2g} %", made.rounds, 100 * made.error);
  if (made.left_out > 0) print_out(", {} of {} creases left out", made.left_out, made.creases);
  if (!is_exr(o)) print_out("; exposure {:.4g}, gamma {:.4g}", o.display.exposure, o.display.gamma);
  print_out("\n");
  print_balance(made);
  warn_of_error(o, made);
}

}  // namespace

void add_radiosity_command(CLI::App& app) {
  auto* command =
      app.add_subcommand("radiosity", "compute the light in a room by radiosity and render it");
  auto o = std::make_shared<RadiosityOptions>();
  command->add_option("SCENE", o->room, "a .room, .nff or .obj file")->required();
  command->add_option("-o,--output", o->output, "the image to write, .png or .exr")
      ->check(check_file_name)
      ->required();
  command->add_option("--size", o->size, "WxH in pixels [the room's]");
  bind_options(*command, radiosity::mesh_fields(), o->light.mesh);
  bind_options(*command, {radiosity::senders_field()}, o->light);
  bind_options(*command, {radiosity::adaptive_field()}, o->adapt);
  bind_options(*command, {radiosity::creases_field()}, o->creases);
  bind_options(*command, radiosity::solve_fields(), o->light.solve,
               {{"max_shots", "shots"}, {"reflections", "mirrors"}});
  command->add_flag("--ambient,!--no-ambient", o->light.ambient,
                    "add an estimate of the unsent light [yes]");
  bind_options(*command, radiosity::reconstruction_fields(), o->reconstruction);
  command->add_flag("--preview", o->preview, "fast picture by z-buffer, in which mirrors are grey");
  bind_options(*command, base::select(radiosity::picture_fields(), {"pixel_samples", "depth"}),
               o->picture);
  command
      ->add_option("--exposure", o->exposure,
                   "a pixel is (exposure x radiosity) ^ (1 / gamma); auto: 1 % of the non-emitting "
                   "pixels are white")
      ->capture_default_str();
  bind_options(*command, base::select(radiosity::display_fields(), {"gamma"}), o->display);
  command
      ->add_option("--stats", o->stats, "write counts of patches, rays and work to this JSON file")
      ->check(check_file_name);
  command->footer(
      "Examples:\n  tlab radiosity experiments/scenes/window.room -o window.png\n  tlab radiosity "
      "experiments/scenes/cornell-tall.room -o tall.png --creases auto --refine 4");
  command->callback([o, command] {
    o->asks_display = command->count("--gamma") + command->count("--exposure") > 0;
    run(*o);
  });
}

}  // namespace laboratory

#include <fmt/format.h>

#include <chrono>
#include <filesystem>

#include "experiments/laboratory/command/command_options.hpp"
#include "experiments/laboratory/command/commands.hpp"
#include "experiments/laboratory/command/radiosity_names.hpp"
#include "experiments/laboratory/host/files.hpp"
#include "experiments/laboratory/host/progress.hpp"
#include "experiments/laboratory/points/work_json.hpp"
#include "renderer/radiosity/creases/discontinuities.hpp"
#include "renderer/radiosity/files/load_room.hpp"
#include "renderer/radiosity/light/solve.hpp"
#include "renderer/radiosity/show/picture.hpp"

namespace laboratory {

namespace {

using radiosity::Mesh;
using radiosity::Picture;
using renderer::Rgb;
using renderer::Work;

// Of the pixels, those that --exposure auto does not cut off: the rest may be lamps.
constexpr double AUTO_SHARE = 0.9;

struct Options {
  std::string room, output, stats, size, exposure;
  radiosity::MeshParams mesh;
  radiosity::SolveParams solve;
  radiosity::ReconstructionParams reconstruction;
  radiosity::PictureParams picture;
  radiosity::Display display;
  Creases creases = Creases::file;
  bool ambient = true, preview = false, gamma_given = false;
};

bool is_exr(const Options& o) { return std::filesystem::path(o.output).extension() == ".exr"; }

void check_output(const Options& o) {
  const auto ending = std::filesystem::path(o.output).extension();
  if (!ending.empty() && ending != ".png" && !is_exr(o))
    throw CLI::ValidationError(
        "--output",
        fmt::format("found \"{}\", expected a name that ends in .png or .exr", o.output));
  if (is_exr(o) && (!o.exposure.empty() || o.gamma_given))
    throw CLI::ValidationError(
        "--output", fmt::format("found \"{}\" with --exposure or --gamma, expected a .png: an .exr "
                                "has linear radiosity",
                                o.output));
  const auto whole = [](const std::string& path) {
    std::error_code ignored;
    return std::filesystem::weakly_canonical(path, ignored);
  };
  if (!o.stats.empty() && whole(o.stats) == whole(o.output))
    throw CLI::ValidationError("--stats", "expected another file than the image's");
  for (const auto& [option, path] :
       {std::pair{"--output", o.output}, std::pair{"--stats", o.stats}})
    if (const auto folder = std::filesystem::path(path).parent_path();
        !folder.empty() && !std::filesystem::is_directory(folder))
      throw CLI::ValidationError(
          option,
          fmt::format("found \"{}\", expected a file in a folder that is there: \"{}\" is none",
                      path, folder.string()));
}

double parse_exposure(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !(value > 0 && value < 1e300))
    throw CLI::ValidationError(
        "--exposure", fmt::format("found \"{}\", expected auto, or a number above 0", text));
  return value;
}

/// Of what has begun, in seconds.
class Clock {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

// What came of a room.
struct Outcome {
  std::size_t patches = 0, vertices = 0, mirrors = 0, creases = 0;
  radiosity::Solution solution;
  Picture picture;
  Work picture_work;
  double mesh_s = 0, solve_s = 0, picture_s = 0;
};

radiosity::Room load(const Options& o) {
  auto room = radiosity::load_room(o.room);
  if (o.creases == Creases::none) room.creases.clear();
  if (o.creases == Creases::found) {
    const auto found = radiosity::find_creases(room);
    room.creases.insert(room.creases.end(), found.begin(), found.end());
  }
  return room;
}

radiosity::Solution solve(const Options& o, const Mesh& mesh) {
  Progress bar("radiosity");
  // Each shot sends about as large a share of what is left, so the bar goes by its logarithm.
  const double end = std::log(std::max(o.solve.tolerance, 1e-9));
  return radiosity::solve(mesh, o.solve, [&](int shots, double unshot) {
    const double by_light = end < 0 ? std::log(std::max(unshot, 1e-9)) / end : 1;
    const double by_shots = o.solve.shots > 0 ? 1.0 * shots / o.solve.shots : 1;
    bar.show(static_cast<std::size_t>(1000 * std::clamp(std::max(by_light, by_shots), 0.0, 1.0)),
             1000);
    return true;
  });
}

Outcome light(const Options& o) {
  Outcome made;
  Clock clock;
  const radiosity::Room room = load(o);
  radiosity::PictureParams picture = o.picture;
  if (o.size.empty()) picture.width = room.view.width, picture.height = room.view.height;
  radiosity::check(picture);
  const Mesh mesh = radiosity::make_mesh(room, o.mesh);
  made.patches = mesh.patches.size();
  made.vertices = mesh.vertices.size();
  made.mirrors = mesh.mirrors.size();
  made.creases = room.creases.size();
  made.mesh_s = clock.lap();

  made.solution = solve(o, mesh);
  made.solve_s = clock.lap();

  std::vector<Rgb> values = made.solution.vertices;
  if (o.ambient) add_ambient(mesh, made.solution.ambient, values);
  const auto illumination = radiosity::reconstruct(mesh, values, o.reconstruction);
  made.picture = o.preview
                     ? preview_picture(mesh, illumination, room.view, picture)
                     : trace_picture(mesh, illumination, room.view, picture, made.picture_work);
  made.picture_s = clock.lap();
  return made;
}

void save_stats(const Options& o, const Outcome& made) {
  const auto rays = static_cast<double>(made.solution.work[renderer::Op::ray_intersected]);
  nlohmann::ordered_json stats = {
      {"scene", o.room},
      {"patches", made.patches},
      {"vertices", made.vertices},
      {"mirrors", made.mirrors},
      {"creases", made.creases},
      {"shots", made.solution.shots},
      {"unshot", made.solution.unshot},
      {"ambient", {made.solution.ambient.r, made.solution.ambient.g, made.solution.ambient.b}},
      {"work", make_json(made.solution.work)},
      {"width", made.picture.width},
      {"height", made.picture.height},
      {"picture_work", make_json(made.picture_work)},
      {"seconds", {{"mesh", made.mesh_s}, {"solution", made.solve_s}, {"picture", made.picture_s}}},
      {"rays_per_second", rays / made.solve_s}};
  if (!is_exr(o)) stats["exposure"] = o.display.exposure, stats["gamma"] = o.display.gamma;
  write_file(o.stats, stats.dump(2) + "\n");
}

void run(Options& o) {
  check_output(o);
  parse_size(o.size, o.picture);
  const bool automatic = o.exposure.empty() || o.exposure == "auto";
  if (!automatic) o.display.exposure = parse_exposure(o.exposure);
  radiosity::check(o.solve.factor);
  radiosity::check(o.picture);
  if (std::isnan(o.solve.tolerance) || std::isnan(o.display.gamma))
    throw CLI::ValidationError(std::isnan(o.solve.tolerance) ? "--tolerance" : "--gamma",
                               "found nan, expected a number");
  const Outcome made = light(o);
  if (automatic) o.display.exposure = radiosity::find_exposure(made.picture, AUTO_SHARE);
  if (is_exr(o))
    radiosity::save_exr(o.output, made.picture);
  else
    radiosity::save_png(o.output, made.picture, o.display);
  if (!o.stats.empty()) save_stats(o, made);
  fmt::print("{} patches, {} vertices, {} shots, {:.3g} % unshot", made.patches, made.vertices,
             made.solution.shots, 100 * made.solution.unshot);
  if (!is_exr(o))
    fmt::print("; exposure {:.4g}, gamma {:.4g}", o.display.exposure, o.display.gamma);
  fmt::print("\n");
}

}  // namespace

void add_radiosity_command(CLI::App& app) {
  auto* command = app.add_subcommand("radiosity", "light a room and show it");
  auto o = std::make_shared<Options>();
  const auto add = [&](const char* option, auto& field, const char* help) {
    return command->add_option(option, field, help)->capture_default_str();
  };
  command->add_option("SCENE", o->room, "a .room, .nff or .obj file")->required();
  command->add_option("-o,--output", o->output, "the image to write, .png or .exr")->required();
  command->add_option("--size", o->size, "WxH in pixels [the room's]");
  add("--refine", o->mesh.refine, "multiplies the divisions of every face")
      ->check(CLI::Range(1, 1000));
  add_choice(command, "--creases", o->creases, CREASES,
             "borders of penumbrae that the mesh keeps: of the file; auto: found too");
  add("--samples", o->solve.factor.samples, "a patch is N x N delta areas, and more when near");
  add("--shots", o->solve.shots, "at most")->check(CLI::NonNegativeNumber);
  add("--tolerance", o->solve.tolerance, "until this share of the light is unshot")
      ->check(CLI::Range(0.0, 1.0));
  add("--mirrors", o->solve.factor.reflections, "that light may meet on its way, 0 to 8");
  command->add_flag("--ambient,!--no-ambient", o->ambient, "an estimate of what is unshot [yes]");
  add_choice(command, "--reconstruction", o->reconstruction.kind, RECONSTRUCTIONS,
             "illumination between vertices");
  add_choice(command, "--twist", o->reconstruction.twist, TWISTS,
             "the mixed derivatives of bicubic surfaces");
  command->add_flag("--preview", o->preview, "by a z-buffer: mirrors are grey");
  add("--pixel-samples", o->picture.samples, "N x N rays a pixel, 1 to 64");
  add("--depth", o->picture.depth, "mirrors that a ray from the eye may meet, 0 to 1000");
  command->add_option(
      "--exposure", o->exposure,
      "a pixel is (exposure x radiosity) ^ (1 / gamma); auto: a tenth is white [auto]");
  add("--gamma", o->display.gamma, "of a PNG")->check(CLI::Range(0.01, 100.0));
  command->add_option("--stats", o->stats,
                      "write counts of patches, rays and work to this JSON file");
  command->callback([o, command] {
    o->gamma_given = command->count("--gamma") > 0;
    run(*o);
  });
}

}  // namespace laboratory

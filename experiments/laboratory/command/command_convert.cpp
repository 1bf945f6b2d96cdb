// tlab convert: a scene, room or mesh in another file format.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/resource.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/errors.hpp"
#include "base/text.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/command/commands.hpp"
#include "experiments/laboratory/host/jobs.hpp"
#include "experiments/laboratory/host/patience.hpp"
#include "renderer/files/load_scene.hpp"
#include "renderer/files/obj_nff.hpp"
#include "renderer/files/write_nff.hpp"
#include "renderer/files/write_obj.hpp"
#include "renderer/meshes/read_mesh.hpp"
#include "renderer/radiosity/files/load_room.hpp"
#include "renderer/radiosity/files/write_room.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;
using renderer::LeftOut;

bool is_mesh(const std::string& source) {
  return std::ranges::any_of(renderer::mesh_endings(),
                             [&](std::string_view ending) { return source.ends_with(ending); });
}

// A file that is to be written.
struct Text {
  std::string path, text;
};
using Texts = std::vector<Text>;

struct Converted {
  Texts texts;
  std::string left_out;
};

Texts write_room(const std::string& source, const std::string& output, LeftOut& left_out) {
  return {{output, radiosity::to_text(radiosity::load_room(source), left_out)}};
}

Texts write_nff(const std::string& source, const std::string& output, LeftOut& left_out) {
  renderer::NffText nff(fs::path(output).parent_path().string());
  if (source.ends_with(".room")) {
    radiosity::tell(radiosity::load_room(source), nff, left_out);
  } else if (source.ends_with(".obj")) {
    renderer::read_scene(base::read_text(source), source, nff);
  } else if (is_mesh(source)) {
    renderer::ObjAsNff obj(nff);
    renderer::read_mesh(source, obj, left_out);
    obj.finish();
  } else {
    renderer::tell(renderer::load_scene(source), nff);
  }
  return {{output, nff.text()}};
}

Texts write_obj(const std::string& source, const std::string& output, LeftOut& left_out) {
  const auto library = fs::path(output).replace_extension(".mtl");
  renderer::ObjText obj(library.parent_path().string(), library.filename().string());
  renderer::NffAsObj nff(obj, left_out);
  if (source.ends_with(".room"))
    radiosity::tell(radiosity::load_room(source), obj, left_out);
  else if (source.ends_with(".nff"))
    renderer::read_nff(base::read_text(source), source, nff);
  else if (is_mesh(source))
    renderer::read_mesh(source, obj, left_out);
  else
    renderer::tell(renderer::load_scene(source), nff);
  return {{library.string(), obj.library()}, {output, obj.text()}};
}

// The same of a mesh in a process of its own, with a limit on its time: see read_mesh().
Converted convert_apart(const std::string& source, const std::function<Converted()>& convert) {
  constexpr double LEAST_S = 1, S_PER_BYTE = 2e-5;
  std::error_code none;
  const auto bytes = fs::file_size(source, none);
  const auto limit_s = static_cast<rlim_t>(LEAST_S + (none ? 0 : S_PER_BYTE * double(bytes)));
  const auto job = [&](std::size_t) {
    const rlimit limit{limit_s, limit_s};
    setrlimit(RLIMIT_CPU, &limit);
    if (!std::freopen("/dev/null", "w", stderr)) throw std::runtime_error("/dev/null");
    const auto [texts, left_out] = convert();
    nlohmann::json json = {{"left_out", left_out}};
    for (const auto& [path, text] : texts) json["texts"].push_back({path, text});
    return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  };
  Converted converted;
  for_each_job(1, 1, job, [&](const JobEnd& end) {
    base::require(end.died.empty(), source, "Assimp cannot read it: {}", end.died);
    const auto json = nlohmann::json::parse(end.result);
    converted.left_out = json["left_out"];
    for (const auto& text : json["texts"]) converted.texts.push_back({text[0], text[1]});
  });
  if (was_interrupted()) throw Interrupted();
  return converted;
}

void convert(const std::string& source, const std::string& output) {
  using Write = Texts (*)(const std::string&, const std::string&, LeftOut&);
  constexpr std::pair<std::string_view, Write> WRITERS[] = {
      {".nff", &write_nff}, {".obj", &write_obj}, {".room", &write_room}};
  const auto ending = fs::path(output).extension().string();
  const auto* writer =
      std::ranges::find(WRITERS, ending, [](const auto& named) { return named.first; });
  base::require(writer != std::end(WRITERS), "-o " + output,
                "found another ending, expected .nff, .obj or .room");
  base::require(fs::path(source).extension() != ending, "-o " + output,
                "found the format of {}, expected another", source);

  const auto convert_here = [&] {
    LeftOut left_out;
    auto texts = writer->second(source, output, left_out);
    return Converted{std::move(texts), left_out.describe()};
  };
  const auto [texts, left_out] = [&] {
    const Patience patience("convert " + source);
    return is_mesh(source) ? convert_apart(source, convert_here) : convert_here();
  }();
  for (const auto& [path, text] : texts) {
    if (text.empty()) continue;  // an OBJ without materials
    base::save_whole(path, text);
    fmt::print("scene    {}\n", path);
  }
  if (!left_out.empty()) fmt::print("left out {}\n", left_out);
}

}  // namespace

void add_convert_command(CLI::App& app) {
  auto* command =
      app.add_subcommand("convert", "write a scene, a room or a mesh in another format");
  struct Options {
    std::string source, output;
  };
  auto o = std::make_shared<Options>();
  command
      ->add_option("SCENE", o->source,
                   fmt::format("an .nff, .obj or .room file, a generator such as spheres:800, or a "
                               "mesh ({})",
                               fmt::join(renderer::mesh_endings(), ", ")))
      ->required();
  command->add_option("-o,--output", o->output, "the .nff, .obj or .room file to write")
      ->required();
  command->footer(
      "What the format has no word for is named.\nExamples:\n  tlab convert "
      "experiments/scenes/still-life.nff -o still-life.obj\n  tlab convert bunny.ply -o bunny.obj");
  command->callback([o] { convert(o->source, o->output); });
}

}  // namespace laboratory

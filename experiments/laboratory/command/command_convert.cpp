// tlab convert: a scene, room or mesh in another file format.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "base/errors.hpp"
#include "base/text.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/command/commands.hpp"
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

  LeftOut left_out;
  const auto texts = [&] {
    const Patience patience("convert " + source);
    return writer->second(source, output, left_out);
  }();
  for (const auto& [path, text] : texts) {
    if (text.empty()) continue;  // an OBJ without materials
    base::save_whole(path, text);
    fmt::print("scene    {}\n", path);
  }
  if (const auto all = left_out.describe(); !all.empty()) fmt::print("left out {}\n", all);
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

// tlab convert: converts a scene, room or mesh to another file format.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/resource.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/errors.hpp"
#include "base/text.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/command/commands.hpp"
#include "experiments/laboratory/host/elapsed_time.hpp"
#include "experiments/laboratory/host/jobs.hpp"
#include "experiments/laboratory/host/streams.hpp"
#include "experiments/laboratory/options/options.hpp"
#include "experiments/laboratory/setup/open_scene.hpp"
#include "renderer/files/obj_nff.hpp"
#include "renderer/files/write_nff.hpp"
#include "renderer/files/write_obj.hpp"
#include "renderer/meshes/read_mesh.hpp"
#include "renderer/radiosity/files/write_room.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;
using renderer::LeftOut;

std::string ending_of(const std::string& path) { return fs::path(path).extension().string(); }

// Recognises a mesh by its file extension, in upper or lower case.
bool is_mesh(const std::string& source) {
  return std::ranges::find(renderer::mesh_endings(), base::to_lower(ending_of(source))) !=
         renderer::mesh_endings().end();
}

std::string list_sources() {
  return fmt::format("an .nff, .obj or .room file, a generator such as spheres:800, or a mesh ({})",
                     fmt::join(renderer::mesh_endings(), ", "));
}

radiosity::Room read_room(const std::string& source, LeftOut& left_out) {
  return radiosity::read_room(base::read_text(source), source, &left_out);
}

// A file to write, with its content.
struct Text {
  std::string path, text;
};
using Texts = std::vector<Text>;

struct Converted {
  Texts texts;
  std::string left_out;
  std::vector<std::string> remarks;
};

Texts write_room(const std::string& source, const std::string& output, LeftOut& left_out) {
  const auto ending = ending_of(source);
  base::require(ending == ".nff" || ending == ".obj", "-o " + output,
                "found {}, expected an .nff or .obj file: convert it to .obj first", source);
  return {{output, radiosity::to_text(read_room(source, left_out), left_out)}};
}

Texts write_nff(const std::string& source, const std::string& output, LeftOut& left_out) {
  renderer::NffText nff(fs::path(output).parent_path().string());
  if (ending_of(source) == ".room") {
    radiosity::tell(read_room(source, left_out), nff, left_out);
  } else if (ending_of(source) == ".obj") {
    renderer::read_scene(base::read_text(source), source, nff, &left_out);
  } else if (is_mesh(source)) {
    renderer::ObjAsNff obj(nff, left_out);
    renderer::read_mesh(source, obj, left_out);
    renderer::at_place(source, [&] { obj.finish(); });
  } else {
    renderer::tell(renderer::load_scene(source), nff);
  }
  return {{output, nff.text()}};
}

// True if `output` is an OBJ file that names `library` as its material file.
bool names_library(const std::string& output, const fs::path& library) {
  if (!fs::is_regular_file(output)) return false;
  const auto text = base::read_own_text(output);
  const auto names_it = [&](std::string_view line) {
    return line.starts_with("mtllib") && base::trim(line.substr(6)) == library.filename().string();
  };
  return std::ranges::any_of(base::split(text, '\n'), names_it);
}

Texts write_obj(const std::string& source, const std::string& output, LeftOut& left_out) {
  const auto library = fs::path(output).replace_extension(".mtl");
  base::require(!fs::exists(library) || names_library(output, library), library.string(),
                "found this file, but no {} that names it, expected neither or both: it would be "
                "overwritten",
                output);
  auto obj = base::at_place("-o " + output, [&] {
    return renderer::ObjText(library.parent_path().string(), library.filename().string());
  });
  renderer::NffAsObj nff(obj, left_out);
  if (ending_of(source) == ".room")
    radiosity::tell(read_room(source, left_out), obj, left_out);
  else if (ending_of(source) == ".nff")
    renderer::read_nff(base::read_text(source), source, nff);
  else if (is_mesh(source))
    renderer::read_mesh(source, obj, left_out);
  else
    renderer::tell(renderer::load_scene(source), nff);
  return {{library.string(), obj.library()}, {output, obj.text()}};
}

// CPU seconds allowed for converting a mesh; the limit grows with the size of the mesh's files.
// Counts the files of the folder that have the mesh's name or the extension .bin, since a .gltf
// file may refer to them.
rlim_t find_time_limit(const std::string& source) {
  constexpr double LEAST_S = 1, S_PER_BYTE = 2e-5;
  std::uintmax_t bytes = 0;
  std::error_code error;
  const auto folder = fs::path(source).parent_path();
  for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder, error))
    if (entry.path().stem() == fs::path(source).stem() || entry.path().extension() == ".bin")
      if (const auto size = entry.is_regular_file(error) ? entry.file_size(error) : 0; !error)
        bytes += size;
  return static_cast<rlim_t>(LEAST_S + S_PER_BYTE * static_cast<double>(bytes));
}

// Converts a mesh in a separate process with a limit on CPU time, because the library Assimp may
// take very long for some files (see read_mesh()).
Converted convert_apart(const std::string& source, const std::function<Converted()>& convert) {
  base::check_can_read(source);
  const auto limit_s = find_time_limit(source);
  const auto job = [&](std::size_t) {
    const rlimit limit{limit_s, limit_s + 1};
    setrlimit(RLIMIT_CPU, &limit);
    // limit on real time: reading a pipe without a writer would block forever
    alarm(static_cast<unsigned>(20 + 10 * limit_s));
    if (!std::freopen("/dev/null", "w", stderr)) throw std::runtime_error("/dev/null");
    const auto [texts, left_out, remarks] = convert();
    // Checks in the child process, because only this process knows which files Assimp has read.
    for (const auto& [path, text] : texts) base::check_no_input(path);
    nlohmann::json json = {{"left_out", left_out}, {"remarks", remarks}};
    for (const auto& [path, text] : texts) json["texts"].push_back({path, text});
    // encoded as CBOR, not as JSON text, because a file name may be invalid UTF-8
    std::string bytes;
    nlohmann::json::to_cbor(json, bytes);
    return bytes;
  };
  Converted converted;
  for_each_job(1, 1, job, [&](const JobEnd& end) {
    base::require(end.died.empty(), source,
                  "found a mesh that takes more than {} s of CPU time, or that the library Assimp "
                  "fails to read, expected another",
                  limit_s);
    const auto json = nlohmann::json::from_cbor(end.result);
    converted.left_out = json["left_out"];
    converted.remarks = json["remarks"];
    for (const auto& text : json["texts"]) converted.texts.push_back({text[0], text[1]});
  });
  if (was_interrupted()) throw Interrupted();
  return converted;
}

void convert(const std::string& source, const std::string& output) {
  using Write = Texts (*)(const std::string&, const std::string&, LeftOut&);
  constexpr std::pair<std::string_view, Write> WRITERS[] = {
      {".nff", &write_nff}, {".obj", &write_obj}, {".room", &write_room}};
  const auto ending = ending_of(output), from = ending_of(source);
  const auto* writer =
      std::ranges::find(WRITERS, ending, [](const auto& named) { return named.first; });
  base::require(writer != std::end(WRITERS), "-o " + output,
                "found another ending, expected .nff, .obj or .room");
  base::require(from == ".nff" || from == ".obj" || from == ".room" || is_mesh(source) ||
                    source.find(':') != source.npos,
                source, "expected {}", list_sources());
  base::require(from != ending, "-o " + output, "found the same format as {}, expected another",
                source);
  base::check_can_save(output);

  const auto convert_here = [&] {
    LeftOut left_out;
    auto texts = writer->second(source, output, left_out);
    return Converted{std::move(texts), left_out.describe(), left_out.describe_remarks()};
  };
  const auto [texts, left_out, remarks] = [&] {
    const ElapsedTime elapsed_time("convert " + source);
    return is_mesh(source) ? convert_apart(source, convert_here) : convert_here();
  }();
  warn(remarks);
  for (const auto& [path, text] : texts)
    if (!text.empty()) base::check_can_save(path);
  for (const auto& [path, text] : texts) {
    if (text.empty()) continue;  // skips the material file of an OBJ without materials
    base::save_whole(path, text);
    print_out("scene    {}\n", path);
  }
  if (!left_out.empty()) print_out("left out {}\n", left_out);
}

}  // namespace

void add_convert_command(CLI::App& app) {
  auto* command =
      app.add_subcommand("convert", "write a scene, a room or a mesh in another format");
  struct Options {
    std::string source, output;
  };
  auto o = std::make_shared<Options>();
  command->add_option("SCENE", o->source, list_sources())->required();
  command
      ->add_option("-o,--output", o->output,
                   "the .nff, .obj or .room file to write; an .obj also gets an .mtl file")
      ->check(check_file_name)
      ->required();
  command->footer(
      "Lists everything that the new format cannot represent.\nExamples:\n  tlab convert "
      "experiments/scenes/glass.nff -o glass.obj\n  tlab convert bunny.ply -o bunny.obj");
  command->callback([o] { convert(o->source, o->output); });
}

}  // namespace laboratory

#include "experiments/laboratory/guide/catalogue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "base/errors.hpp"
#include "base/message.hpp"
#include "base/text.hpp"
#include "base/toml.hpp"
#include "base/whole_file.hpp"
#include "simulator/machine/model.hpp"
#include "simulator/programs/programs.hpp"
#include "topologies/make/generators.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;

using Entries = std::vector<Catalogue::Entry>;

// The path of a file, relative to the current folder if the file is inside this folder.
fs::path show_near(const fs::path& file) {
  const auto near = fs::absolute(file).lexically_normal().lexically_proximate(fs::current_path());
  return near.begin() != near.end() && *near.begin() != ".." ? near : file;
}

// Lists the files below a folder that have one of these extensions, sorted by name. The path of a
// file inside the current folder becomes relative to it.
std::vector<fs::path> find_files(const fs::path& folder, const std::vector<std::string>& endings) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end;
       at.increment(error))
    if (at->is_regular_file() &&
        std::ranges::find(endings, at->path().extension().string()) != endings.end())
      files.push_back(at->path());
  if (error) throw base::BadInput(fmt::format("{}: {}", folder.string(), error.message()));
  for (auto& file : files) file = show_near(file);
  std::ranges::sort(files);
  return files;
}

// The first 4096 bytes of a file, which contain its first comment; "" if the file is unreadable.
std::string read_beginning(const fs::path& file) {
  std::string text(4096, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, in.gcount())));
  return text;
}

// The title of an experiment; no value for other TOML files and for unreadable files.
std::optional<std::string> find_title(const fs::path& file) try {
  constexpr std::size_t LONGEST = 1 << 20;
  const auto table = base::parse_toml(base::read_text(file, LONGEST), file.string());
  return table["title"].value<std::string>();
} catch (const base::BadInput&) {
  return std::nullopt;
}

Entries list_experiments(const std::optional<fs::path>& folder) {
  Entries entries;
  if (folder)
    for (const auto& file : find_files(*folder, {".toml"}))
      if (const auto title = find_title(file)) entries.push_back({file.string(), *title});
  return entries;
}

Entries list_programs() {
  Entries entries;
  for (const auto& program : programs::all_programs())
    entries.push_back({program.name, program.help});
  return entries;
}

Entries list_topologies() {
  Entries entries;
  for (const auto& generator : topologies::generators())
    entries.push_back({generator.form, generator.help});
  return entries;
}

Entries list_models() {
  Entries entries;
  for (const auto& name : machine::builtin_models())
    entries.push_back({name, machine::describe_builtin(name)});
  return entries;
}

Entries list_scenes(const std::optional<fs::path>& folder) {
  Entries entries{{"spheres:N", "the first N spheres of Haines's sphereflake, breadth first"},
                  {"hills:N", "a lake in front of mountains, of N triangles"},
                  {"room:L", "a room with a glass table, a window and L lights"}};
  if (folder)
    for (const auto& file : find_files(*folder, {".nff", ".room", ".obj"}))
      entries.push_back({file.string(), base::first_comment(read_beginning(file))});
  return entries;
}

struct Kind {
  const char* name;
  const char* use;
};
constexpr Kind KINDS[] = {{"experiments", "tlab run FILE"},
                          {"programs", "program.name; tlab help PROGRAM"},
                          {"topologies", "network.topology; tlab topology SPEC"},
                          {"models", "machine.model; tlab model NAME"},
                          {"scenes", "scene.source; tlab render SCENE, tlab radiosity ROOM"}};

}  // namespace

const std::vector<std::string>& catalogue_kinds() {
  static const std::vector<std::string> kinds = [] {
    std::vector<std::string> names;
    for (const auto& kind : KINDS) names.emplace_back(kind.name);
    return names;
  }();
  return kinds;
}

std::optional<fs::path> find_experiments() {
  std::error_code error;
  const auto program = fs::read_symlink("/proc/self/exe", error);
  if (error) return std::nullopt;
  const auto folder = program.parent_path();
  for (const auto& place : {folder / "../../experiments", folder / "../share/tlab/experiments"})
    if (fs::exists(place / "farm.toml", error)) return place.lexically_normal();
  return std::nullopt;
}

std::string find_listed(const std::string& name) {
  std::error_code error;
  const auto folder = find_experiments();
  if (!folder || fs::exists(name, error)) return name;
  auto file = *folder / name;
  if (file.extension() != ".toml") file += ".toml";
  return fs::is_regular_file(file, error) ? show_near(file).string() : name;
}

Catalogue make_catalogue(const std::string& kind, const std::optional<fs::path>& folder) {
  const auto found = std::ranges::find_if(KINDS, [&](const Kind& k) { return k.name == kind; });
  if (found == std::end(KINDS))
    throw base::BadInput(
        fmt::format("unknown kind \"{}\"{}", kind, base::suggest(kind, catalogue_kinds())));
  Catalogue catalogue{kind, found->use, {}};
  if (kind == "experiments") catalogue.entries = list_experiments(folder);
  if (kind == "programs") catalogue.entries = list_programs();
  if (kind == "topologies") catalogue.entries = list_topologies();
  if (kind == "models") catalogue.entries = list_models();
  if (kind == "scenes") catalogue.entries = list_scenes(folder);
  return catalogue;
}

std::string to_text(const Catalogue& catalogue) {
  std::size_t width = 0;
  for (const auto& entry : catalogue.entries) width = std::max(width, entry.name.size());
  std::string text = fmt::format("{} ({}):\n", catalogue.kind, catalogue.use);
  for (const auto& [name, about] : catalogue.entries)
    text += about.empty() ? fmt::format("  {}\n", base::blank_controls(name))
                          : fmt::format("  {:<{}}  {}\n", base::blank_controls(name), width,
                                        base::blank_controls(about));
  return text;
}

}  // namespace laboratory

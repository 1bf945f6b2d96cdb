// Who may include whom: architecture.md as a test over the #include lines of the sources.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

struct Source {
  std::string path, room;             // from the root of the repository
  std::vector<std::string> includes;  // as written
  int lines = 0;
};

// "simulator/occam/alt.hpp" is of the room "simulator/occam", "renderer/x/y.hpp" of "renderer".
std::string room_of(const std::string& path) {
  const auto first = path.find('/');
  const auto second = path.find('/', first + 1);
  return path.substr(0, path.starts_with("simulator/") ? second : first);
}

std::vector<Source> load_sources() {
  const fs::path root = TLAB_SOURCE_DIR;
  const std::regex include(R"re(\s*#\s*include\s*[<"]([^>"]+)[>"].*)re");
  std::vector<Source> sources;
  for (const char* top : {"topologies", "renderer", "simulator", "experiments", "tests"})
    for (const auto& file : fs::recursive_directory_iterator(root / top)) {
      const auto extension = file.path().extension();
      if (extension != ".hpp" && extension != ".cpp") continue;
      Source source{fs::relative(file.path(), root).generic_string(), "", {}, 0};
      source.room = room_of(source.path);
      std::ifstream in(file.path());
      std::smatch match;
      for (std::string line; std::getline(in, line); ++source.lines)
        if (std::regex_match(line, match, include)) source.includes.push_back(match[1]);
      sources.push_back(std::move(source));
    }
  return sources;
}

const std::vector<Source>& sources() {
  static const auto all = load_sources();
  return all;
}

bool is_ours(const std::string& include) {
  return std::ranges::any_of(sources(), [&](const Source& s) {
    return include.starts_with(s.room.substr(0, s.room.find('/')) + "/");
  });
}

using Edges = std::map<std::string, std::set<std::string>>;

// A room, and the rooms that it may include beside itself.
const Edges& allowed() {
  static const std::set<std::string> below_systems = {"topologies",        "renderer",
                                                      "simulator/machine", "simulator/occam",
                                                      "simulator/network", "simulator/observe"};
  static const Edges edges = [] {
    Edges all = {
        {"topologies", {}},
        {"renderer", {}},
        {"simulator/machine", {"topologies"}},
        {"simulator/occam", {"topologies", "simulator/machine"}},
        {"simulator/network", {"topologies", "simulator/machine", "simulator/occam"}},
        {"simulator/observe", {"topologies", "simulator/machine"}},
        {"simulator/patterns",
         {"topologies", "simulator/machine", "simulator/occam", "simulator/network",
          "simulator/observe", "simulator/iirra", "simulator/amp", "renderer"}},
        {"simulator/farm", below_systems},
        {"simulator/iirra", below_systems},
        {"simulator/amp", below_systems},
        {"experiments", below_systems},
    };
    all["simulator/iirra"].insert("simulator/farm");
    all["simulator/amp"].insert({"simulator/farm", "simulator/iirra"});
    all["experiments"].insert(
        {"simulator/farm", "simulator/iirra", "simulator/amp", "simulator/patterns"});
    return all;
  }();
  return edges;
}

TEST(IncludeGraph, RoomsIncludeOnlyWhatArchitectureAllows) {
  ASSERT_GT(sources().size(), 50u);
  for (const Source& source : sources()) {
    if (source.room == "tests") continue;
    const auto room = allowed().find(source.room);
    ASSERT_NE(room, allowed().end())
        << source.path << " is in a room architecture.md does not have";
    for (const auto& include : source.includes)
      if (is_ours(include) && room_of(include) != source.room) {
        EXPECT_TRUE(room->second.contains(room_of(include)))
            << source.path << " includes " << include;
      }
  }
}

TEST(IncludeGraph, IncludesAreFromTheRoot) {
  const fs::path root = TLAB_SOURCE_DIR;
  for (const Source& source : sources())
    for (const auto& include : source.includes)
      if (is_ours(include)) {
        EXPECT_TRUE(fs::exists(root / include) || fs::exists(root / (include + ".in")))
            << source.path << " includes " << include;
      } else {
        EXPECT_FALSE(fs::exists((root / source.path).parent_path() / include))
            << source.path << " includes its neighbour " << include << " without its folder";
      }
}

// Whether a walk along the edges from `at` leads back to a node it came by.
bool has_cycle(const Edges& edges, const std::string& at, std::vector<std::string>& way,
               std::set<std::string>& done) {
  if (std::ranges::find(way, at) != way.end()) return true;
  if (!done.insert(at).second) return false;
  way.push_back(at);
  if (const auto found = edges.find(at); found != edges.end())
    for (const auto& next : found->second)
      if (has_cycle(edges, next, way, done)) return true;
  way.pop_back();
  return false;
}

void expect_no_cycle(const Edges& edges) {
  std::set<std::string> done;
  for (const auto& [from, ignored] : edges) {
    std::vector<std::string> way;
    if (!has_cycle(edges, from, way, done)) continue;
    std::string text;
    for (const auto& step : way) text += step + " -> ";
    FAIL() << "a cycle: " << text << "...";
  }
}

TEST(IncludeGraph, HasNoCycleOfFoldersNorOfFiles) {
  Edges folders, files;
  for (const Source& source : sources())
    for (const auto& include : source.includes)
      if (is_ours(include)) {
        const auto from = fs::path(source.path).parent_path().generic_string();
        const auto to = fs::path(include).parent_path().generic_string();
        if (from != to) folders[from].insert(to);
        files[source.path].insert(include);
      }
  expect_no_cycle(folders);
  expect_no_cycle(files);
}

// A dependency, by how its headers begin, and the only files that may include them.
struct Door {
  std::vector<std::string> headers;
  std::regex files;
};

TEST(IncludeGraph, DependenciesEnterThroughTheirDoors) {
  const Door doors[] = {
      // (tests/benchmarks/raw_simgrid.cpp is SimGrid without us, to be measured against.)
      {{"simgrid/", "xbt/"},
       std::regex("simulator/machine/engine\\.cpp|"
                  "tests/benchmarks/raw_simgrid\\.cpp")},
      {{"boost/graph/"}, std::regex("topologies/[^/]*\\.cpp")},
      {{"boost/container/"}, std::regex("renderer/radiosity/mirror_path\\.hpp")},
      {{"boost/context/"}, std::regex("simulator/machine/process\\.hpp")},
      {{"CLI/"}, std::regex("experiments/.*")},
      {{"muParser"}, std::regex("simulator/machine/formula\\.cpp")},
      {{"toml++/"}, std::regex("simulator/machine/model_file\\.cpp|experiments/.*")},
      {{"nlohmann/"}, std::regex("experiments/.*|tests/experiments/.*")},
      {{"benchmark/", "embree3/"}, std::regex("tests/benchmarks/.*")},
      {{"png.h"}, std::regex("renderer/.*\\.cpp|tests/renderer/.*")},
      {{"OpenEXR/"}, std::regex("renderer/radiosity/exr\\.cpp|tests/renderer/.*")},
  };
  for (const Source& source : sources())
    for (const auto& include : source.includes)
      for (const Door& door : doors)
        if (std::ranges::any_of(door.headers, [&](auto& h) { return include.starts_with(h); })) {
          EXPECT_TRUE(std::regex_match(source.path, door.files))
              << source.path << " includes " << include;
        }
}

TEST(IncludeGraph, FilesHaveFewerThan300Lines) {
  for (const Source& source : sources())
    EXPECT_LT(source.lines, 300) << source.path << ": what is its second subject?";
}

}  // namespace

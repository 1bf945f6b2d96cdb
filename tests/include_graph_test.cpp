// Tests the dependencies between rooms. A room is the library that is built from one source folder.
// Compares the #include lines of all sources with the permitted dependencies.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/support/places.hpp"

namespace {

namespace fs = std::filesystem;

struct Source {
  // path from the root of the repository, and the room to which the file belongs
  std::string path, room;
  std::vector<std::string> includes;  // the included paths, as spelled in the source
};

// The room of a file is the folder that contains it.
std::string room_of(const std::string& path) {
  return fs::path(path).parent_path().generic_string();
}

std::vector<Source> load_sources() {
  const fs::path root = ::test::in_sources("");
  const std::regex include(R"re(\s*#\s*include\s*[<"]([^>"]+)[>"].*)re");
  std::vector<Source> sources;
  for (const char* top : {"base", "topologies", "renderer", "simulator", "experiments", "tests"})
    for (const auto& file : fs::recursive_directory_iterator(root / top)) {
      const auto extension = file.path().extension();
      if (extension != ".hpp" && extension != ".cpp") continue;
      Source source{fs::relative(file.path(), root).generic_string(), "", {}};
      source.room = room_of(source.path);
      std::ifstream in(file.path());
      std::smatch match;
      for (std::string line; std::getline(in, line);)
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

// Adds to `known` all rooms on which `room` depends, directly or indirectly.
void close_over(const Edges& knows, const std::string& room, std::set<std::string>& known) {
  for (const auto& other : knows.at(room))
    if (known.insert(other).second) close_over(knows, other, known);
}

// Loads the rooms of CMakeLists.txt. Each room may include the rooms that its line add_room()
// names, and all rooms that those may include.
Edges load_rooms() {
  std::ifstream in(::test::in_sources("CMakeLists.txt"));
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::regex room(R"(\n *add_room\(([^)]*)\))"), word(R"(\S+)");
  Edges knows;
  for (std::sregex_iterator match(text.begin(), text.end(), room), none; match != none; ++match) {
    const std::string words = (*match)[1];
    std::string name, section;
    for (std::sregex_iterator w(words.begin(), words.end(), word); w != none; ++w) {
      const std::string next = w->str();
      if (name.empty())
        knows[name = next];
      else if (next == "WITH" || next == "KNOWS" || next == "LINKS" || next == "USES")
        section = next;
      else if (section == "KNOWS")
        knows[name].insert(next);
    }
  }
  Edges all;
  for (const auto& [name, ignored] : knows) close_over(knows, name, all[name]);
  return all;
}

const Edges& allowed() {
  static const Edges all = load_rooms();
  return all;
}

TEST(IncludeGraph, RoomsIncludeOnlyWhatTheyKnow) {
  ASSERT_GT(sources().size(), 50u);
  ASSERT_GT(allowed().size(), 30u);
  for (const Source& source : sources()) {
    if (source.path.starts_with("tests/") || source.path.starts_with("experiments/examples/"))
      continue;
    const auto room = allowed().find(source.room);
    ASSERT_NE(room, allowed().end()) << source.path << " is in no room of CMakeLists.txt";
    for (const auto& include : source.includes)
      if (is_ours(include) && room_of(include) != source.room) {
        EXPECT_TRUE(room->second.contains(room_of(include)))
            << source.path << " includes " << include;
      }
  }
}

// The rooms that tests in a folder of tests/ may include: the tested room, which usually has the
// folder's name, and all rooms on which it depends. Code in tests/support, which many tests share,
// may use only the room occam and the rooms on which occam depends.
std::set<std::string> rooms_tested_in(const std::string& folder) {
  const std::map<std::string, std::string> others{{"laboratory", "experiments/laboratory"},
                                                  {"support", "simulator/occam"},
                                                  {"benchmarks", "simulator"},
                                                  {"consumer", "simulator"},
                                                  {"fuzz", "experiments/laboratory"},
                                                  {"mutation", "base"},
                                                  {"reference", "experiments/laboratory"}};
  const auto other = others.find(folder);
  const std::string top = other == others.end() ? folder : other->second;
  std::set<std::string> rooms;
  for (const auto& [room, known] : allowed())
    if (room == top || room.starts_with(top + "/")) {
      rooms.insert(room);
      rooms.insert(known.begin(), known.end());
    }
  return rooms;
}

// Adds the includes of a file, and those of the test headers that it includes.
void add_includes(const std::string& path, std::set<std::string>& all) {
  const auto found = std::ranges::find(sources(), path, &Source::path);
  if (found == sources().end()) return;
  for (const auto& include : found->includes)
    if (all.insert(include).second && include.starts_with("tests/")) add_includes(include, all);
}

TEST(IncludeGraph, TestsIncludeOnlyWhatTheirRoomsKnow) {
  std::map<std::string, std::set<std::string>> tops;
  for (const Source& source : sources()) {
    if (!source.path.starts_with("tests/") || source.room == "tests") continue;
    const auto folder = source.room.substr(6, source.room.find('/', 6) - 6);
    if (!tops.contains(folder)) tops[folder] = rooms_tested_in(folder);
    const auto& rooms = tops.at(folder);
    ASSERT_FALSE(rooms.empty()) << source.room << " tests no room";
    std::set<std::string> includes;
    add_includes(source.path, includes);
    for (const auto& include : includes)
      if (is_ours(include) && !include.starts_with("tests/")) {
        EXPECT_TRUE(rooms.contains(room_of(include))) << source.path << " reaches " << include;
      }
  }
  EXPECT_GE(tops.size(), 5u);
}

TEST(IncludeGraph, FoldersHaveFewSources) {
  constexpr int MOST = 25;
  std::map<std::string, int> counts;
  for (const Source& source : sources()) ++counts[source.room];
  for (const auto& [room, count] : counts) EXPECT_LE(count, MOST) << room << " wants walls";
}

// In a unity build, a `using namespace` or a #pragma in one source would also affect the sources
// that follow. The examples and the benchmarks are never built in this way.
TEST(IncludeGraph, SourcesLeakNoNamespaceAndNoPragma) {
  for (const Source& source : sources()) {
    if (source.room == "experiments/examples" || source.room == "tests/benchmarks") continue;
    std::ifstream in(::test::in_sources(source.path));
    int pushed = 0;
    for (std::string line; std::getline(in, line);) {
      EXPECT_FALSE(line.starts_with("using namespace")) << source.path;
      if (!line.starts_with("#pragma") || line == "#pragma once") continue;
      pushed += line.ends_with(" push") - line.ends_with(" pop");
      EXPECT_TRUE(pushed > 0 || line.ends_with(" pop")) << source.path << ": " << line;
    }
    EXPECT_EQ(pushed, 0) << source.path;
  }
}

TEST(IncludeGraph, IncludesAreFromTheRoot) {
  const fs::path root = ::test::in_sources("");
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

// True if the edges lead from `at` back to a node that is already in `way`.
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

// An external library: the beginnings of its headers' names, and the only files that may include
// them.
struct Door {
  std::vector<std::string> headers;
  std::regex files;
};

TEST(IncludeGraph, DependenciesEnterThroughTheirDoors) {
  const Door doors[] = {
      // Two tests use SimGrid directly: raw_simgrid.cpp measures SimGrid alone for comparison, and
      // forecast_test.cpp makes SimGrid contradict forecasts.
      {{"simgrid/", "xbt/"},
       std::regex("simulator/machine/carriers/simgrid\\.cpp|tests/simulator/machine/carriers/"
                  "forecast_test\\.cpp|"
                  "tests/benchmarks/raw_simgrid\\.cpp")},
      {{"boost/graph/"}, std::regex("topologies/.*\\.cpp")},
      {{"boost/container/"},
       std::regex("renderer/radiosity/light/mirrors\\.cpp|simulator/occam/alt\\.hpp|"
                  "renderer/progressive/sampled_cell\\.(hpp|cpp)")},
      {{"boost/context/"}, std::regex("simulator/machine/carriers/fiber\\.cpp")},
      {{"assimp/"}, std::regex("renderer/meshes/read_mesh\\.cpp")},
      {{"expat.h"},
       std::regex("topologies/files/xml\\.cpp|tests/laboratory/judge/test_report_test\\.cpp")},
      {{"CLI/"},
       std::regex("(experiments|tests)/laboratory/(command|options|picture)/.*|tests/"
                  "(fuzz|reference)/main\\.cpp")},
      {{"muParser"}, std::regex("base/formula\\.cpp")},
      {{"toml++/"}, std::regex("base/toml\\.[ch]pp|experiments/laboratory/.*")},
      {{"kainjow/"}, std::regex("experiments/laboratory/(report/report|plot/plot_script)\\.cpp")},
      {{"boost/math/"}, std::regex("experiments/laboratory/table/statistics\\.cpp")},
      {{"xxhash"}, std::regex("experiments/laboratory/host/hash\\.cpp")},
      {{"nlohmann/"}, std::regex("experiments/laboratory/.*|tests/laboratory/.*")},
      {{"benchmark/"}, std::regex("tests/benchmarks/.*")},
      {{"pybind11/"}, std::regex("experiments/python/bindings/.*")},
      {{"metis.h"}, std::regex("topologies/graph/partition\\.cpp")},
      {{"embree3/", "embree4/"}, std::regex("tests/support/embree\\.hpp")},
      {{"png.h"}, std::regex("renderer/.*\\.cpp|tests/renderer/.*")},
      {{"webp/"}, std::regex("renderer/image/animation\\.cpp|tests/support/webp_frames\\.hpp")},
      {{"cairo/"}, std::regex("experiments/laboratory/(film/canvas|figure/pdf)\\.cpp")},
      {{"OpenEXR/"}, std::regex("renderer/image/picture\\.cpp|tests/renderer/.*")},
  };
  for (const Source& source : sources())
    for (const auto& include : source.includes)
      for (const Door& door : doors)
        if (std::ranges::any_of(door.headers, [&](auto& h) { return include.starts_with(h); })) {
          EXPECT_TRUE(std::regex_match(source.path, door.files))
              << source.path << " includes " << include;
        }
}

}  // namespace

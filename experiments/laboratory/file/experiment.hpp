#pragma once
// The experiment file: one TOML file that describes a machine, a topology, a scene and a strategy.
#include <array>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/laboratory/file/checks.hpp"
#include "experiments/laboratory/file/figures.hpp"
#include "renderer/trace/shade.hpp"
#include "simulator/declare/program.hpp"
#include "simulator/farm/farm.hpp"
#include "simulator/farm/shared_farm.hpp"

namespace laboratory {

// A [[fault]], and where it stands: "e.toml:12: [[fault]] 2".
struct FaultSpec {
  programs::PlannedFault fault;
  std::string place;
};

// One run, with every key of the file at its value or default.
struct Experiment {
  std::string title, question;
  std::string program = "farm";                           // [program]: or the name of a pattern
  std::map<std::string, double, std::less<>> parameters;  // of the pattern, each with a value
  std::map<std::string, programs::NamedFile, std::less<>> files;  // and those that are paths
  std::string model = "t805-25";                                  // [machine]
  // [model]: "link.one_way_rate" and its value in TOML's spelling.
  std::vector<std::pair<std::string, std::string>> model_overrides;
  std::string topology = "tree";  // [network]: a generator sized by `workers`, a spec, or a file
  std::int64_t workers = 7;
  int switches = 0;  // C004 link switches on every link between workers, but on those of
  std::vector<std::array<int, 3>> switches_between;  // these: two workers, from 0, and how many
  std::string routes;                // a file with some of the routes; "": the shortest
  std::string tree;                  // of messages to all: per_root, single; "": as tree_links say
  topologies::TreeLinks tree_links;  // of the single tree; none: breadth first from the root
  std::vector<FaultSpec> faults;     // [[fault]]
  std::string scene = "spheres";     // [scene]: "spheres" made of `objects`, or a file
  std::int64_t objects = 200;
  farm::Params farm;             // [image], [farm], [[stage]], [[order]]
  farm::SharedParams data;       // [data]
  bool has_data = false;         // whether the file has any of its keys
  std::string cost = "counted";  // [run]
};

// A key of the experiment file.
struct Setting {
  std::string key;   // "scene.objects"; an axis of [sweep] is called by its last part, "objects",
                     // but one of the model "model.link.one_way_rate"
  std::string help;  // what it is, with unit and range
};
const std::vector<Setting>& settings();

// A value along an axis, as TOML spells it and as a table shows it.
struct Coordinate {
  std::string axis;  // "objects"
  std::string toml;  // "200"
};

// One point of a sweep.
struct Point {
  std::vector<Coordinate> at;  // the axes of [sweep], in order
  Experiment experiment;
  // The numbers that the file gives to keys: "image.width" -> 100. What it leaves to defaults is
  // not here.
  std::map<std::string, double, std::less<>> numbers;
};

// "objects = 200, workers = 3"; "" for the one point of a file without a sweep.
std::string name_of(const Point& point);

struct ExperimentFile {
  std::string path;               // as it was spelled, wherever that was
  std::string resolved;           // the file with --set applied, as TOML
  std::vector<std::string> axes;  // of [sweep]
  std::vector<Point> points;      // the last axis runs fastest; one point if there is no sweep
  std::vector<Definition> definitions;  // [let]
  std::vector<Check> checks;            // [[check]]
  // Axes whose values go together, "workers, height" = [[1, 16], ...]; of each such entry the
  // names.
  std::vector<std::vector<std::string>> coupled = {};
  std::vector<PlotSpec> plots = {};         // [[plot]]
  std::vector<BestSpec> bests = {};         // [[best]]
  ReportSpec report = {};                   // [report]
  std::vector<std::string> axis_keys = {};  // "scene.objects", of each axis
  // What the file gives to keys that change what a point does, as TOML spells it.
  std::map<std::string, std::string> settings = {};
  std::string folder = {};  // that the paths in the file are relative to; "" is the current one
};

// Reads and checks a file. `overrides` are "key.path=value" in TOML's spelling; a value may also be
// a bare word. Paths in the file are relative to its folder. Throws base::BadInput naming
// the file and line or key, what was found, and the nearest valid key.
ExperimentFile load_experiment(const std::string& path, const std::vector<std::string>& overrides);

// The same of a text, as if it stood in the file `path`, but paths are relative to `folder`.
ExperimentFile read_experiment(const std::string& text, const std::string& path,
                               const std::string& folder,
                               const std::vector<std::string>& overrides);

}  // namespace laboratory

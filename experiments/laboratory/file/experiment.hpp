#pragma once
// The experiment file: one TOML file that describes a machine, a topology, a scene and a strategy.
#include <any>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/laboratory/file/checks.hpp"
#include "simulator/programs/programs.hpp"

namespace laboratory {

/// A [[fault]] and its position in the file, "e.toml:12: [[fault]] 2".
struct FaultSpec {
  programs::PlannedFault fault;
  std::string place;
};

/// A machine model, by name or from a file, with entries that override its own.
struct ModelSpec {
  base::Source source;
  /// For example "link.one_way_rate" and its value in TOML's spelling.
  std::vector<std::pair<std::string, std::string>> entries = {};
};

/// A [[processor]]: a processor of the topology with another model than the machine.
struct OtherProcessor {
  int number = 0;
  ModelSpec model;
  std::string place;  ///< "e.toml:12: [[processor]] 2"
};

/// One run: every key of the file with its value or default. Paths are relative to the current
/// folder; texts keep the file's spelling.
struct Experiment {
  std::string title, question;
  const programs::Program* program = nullptr;  ///< program.name
  std::any params;                             ///< of the program
  ModelSpec model{{"t805-25", "t805-25"}};     ///< machine.model, with [model]
  std::vector<OtherProcessor> others;          ///< [[processor]]
  base::Source topology{"tree", "tree"};  ///< a generator sized by `workers`, a spec, or a file
  std::int64_t workers = 7;               ///< processors of the network
  int switches = 0;  ///< C004 link switches on every link, except in `switches_between`
  std::vector<std::array<int, 3>> switches_between;  ///< two processors, from 0, and a number
  base::Source routes;               ///< "xy", or a file with some of the routes; "": the shortest
  std::string tree;                  ///< for broadcasts: per_root, single; "": as tree_links say
  topologies::TreeLinks tree_links;  ///< of the single tree; none: breadth first from the root
  std::vector<FaultSpec> faults;     ///< [[fault]]
  bool is_timed = false;             ///< run.cost
  machine::Links links = machine::Links::simgrid;             ///< run.engine
  machine::Processes processes = machine::Processes::fibers;  ///< run.processes
  std::optional<double> cycles_per_host_s = {};               ///< for timed costs, once measured
};

/// The files that a point reads, except its machine model: scene, network, routes ...
std::vector<std::string> files_of(const Experiment& experiment);

/// [uncertain]: the number of machines to draw from the ranges of the models' entries.
struct Uncertain {
  std::int64_t machines = 0;  ///< 0: none
  std::int64_t seed = 1;
};

/// A key of the experiment file.
struct Setting {
  std::string key;   ///< "scene.objects"; an axis of [sweep] uses the last part, "objects", and an
                     ///< entry of the model "model.link.one_way_rate"
  std::string help;  ///< meaning, unit and range
};
std::vector<Setting> settings();

/// A value along an axis.
struct Coordinate {
  std::string axis;  ///< "objects"
  std::string toml;  ///< "200", as TOML spells it
};

/// One point of a sweep.
struct Point {
  std::vector<Coordinate> at;  ///< the axes of [sweep], in order
  Experiment experiment;
  /// The numbers that the file assigns to keys, "image.width" -> 100; defaults are not included.
  std::map<std::string, double, std::less<>> numbers;
};

/// "objects = 200, workers = 3"; "" for the only point of a file without a sweep.
std::string name_of(const Point& point);

struct ExperimentFile {
  std::string path;      ///< as spelled by the user, relative to the folder of that time
  std::string folder;    ///< base of the relative paths in the file; "" is the current folder
  std::string resolved;  ///< the file with --set applied, as TOML
  std::vector<std::string> axes;       ///< of [sweep]
  std::vector<std::string> axis_keys;  ///< the key of each axis, "scene.objects"
  /// Groups of axes that take their values together: "workers, height" = [[1, 16], ...].
  std::vector<std::vector<std::string>> coupled;
  std::vector<Point> points;  ///< the last axis varies fastest; one point without a sweep
  /// The file's values for keys that change the work of a point, in TOML's spelling.
  std::map<std::string, std::string> settings;
  std::vector<Definition> definitions;  ///< [let]
  std::vector<Check> checks;            ///< [[check]]
  std::vector<PlotSpec> plots;          ///< [[plot]]
  std::vector<BestSpec> bests;          ///< [[best]]
  std::vector<BaselineSpec> baselines;  ///< [[baseline]]
  ReportSpec report;                    ///< [report]
  Uncertain uncertain;                  ///< [uncertain]
};

/// Reads and checks a file. `overrides` are "key.path=value" in TOML's spelling; a value may also
/// be a bare word. Paths in the file are relative to its folder. Throws BadInput with the file, the
/// line or key, the text found, and the nearest valid key.
ExperimentFile load_experiment(const std::string& path, const std::vector<std::string>& overrides);

/// Reads a text like the content of the file `path`, but with paths relative to `folder`.
ExperimentFile read_experiment(const std::string& text, const std::string& path,
                               const std::string& folder,
                               const std::vector<std::string>& overrides);

}  // namespace laboratory

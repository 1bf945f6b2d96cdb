#pragma once
// The experiment file: a TOML file that describes a machine, a topology, a scene and a strategy.
#include <any>
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <ranges>
#include <string>
#include <utility>
#include <vector>

#include "base/toml.hpp"
#include "experiments/laboratory/file/checks.hpp"
#include "simulator/programs/programs.hpp"

namespace laboratory {

/// A value of a TOML file. Keeps the table that contains it alive.
using Node = std::shared_ptr<const toml::node>;
/// Makes a TOML value from a truth value, a number, a string or a list of strings.
Node make_node(const base::Scalar& value);

/// A [[fault]]: a planned failure of a link or processor, with its position for errors, "e.toml:12:
/// [[fault]] 2".
struct FaultSpec {
  programs::PlannedFault fault;
  std::string place;
};

/// A machine model, by name or from a file, with the entries that the experiment overrides.
struct ModelSpec {
  base::Source source;
  machine::Overrides entries = {};
};

/// A [[processor]]: a processor of the network that has a model of its own.
struct OtherProcessor {
  int number = 0;
  ModelSpec model;
  std::string place;  ///< position for errors, "e.toml:12: [[processor]] 2"
};

/// The settings of one point: every key of the file with its value or default. Paths are relative
/// to the current folder. Strings are spelled as in the file.
struct Experiment {
  std::string title, question;
  const programs::Program* program = nullptr;  ///< program that the key program.name selects
  std::any params;                             ///< parameters of the program
  /// model of the machine, from machine.model and [model]
  ModelSpec model{{"t805-25", "t805-25"}};
  std::vector<OtherProcessor> others;  ///< processors with other models, from [[processor]]
  /// name of a generator, which makes `workers` processors; a full specification such as "tree:7";
  /// or a file
  base::Source topology{"tree", "tree"};
  std::int64_t workers = 7;  ///< number of processors in the network
  int switches = 0;          ///< C004 link switches on every link not listed in `switches_between`
  /// triples: two processors, counted from 0, and the number of switches on each link between them
  std::vector<std::array<int, 3>> switches_between;
  /// "xy"; or a file with some of the routes, all others being shortest routes; "": shortest routes
  base::Source routes;
  /// broadcast trees: "per_root" or "single"; "": "single" if `tree_links` is not empty, else
  /// "per_root"
  std::string tree;
  /// links of the single tree; if empty, the tree is found by breadth-first search from the root
  topologies::TreeLinks tree_links;
  std::vector<FaultSpec> faults;  ///< faults from [[fault]]
  /// number of seeds to simulate each point with; the seeds become an axis of the sweep
  std::int64_t repetitions = 1;
  bool is_timed = false;         ///< true if the key run.cost is "timed"
  machine::EngineParams engine;  ///< from the keys run.engine and run.processes
  /// cycles of simulated work per second of host CPU time, for timed costs; no value until measured
  std::optional<double> cycles_per_host_s = {};
};

/// The keys of a file that determine the settings of points, by their dotted names.
using Keys = std::map<std::string, Node>;
/// Lists the keys of a file that determine the settings of points. Omits [sweep], [let], [[check]]
/// and the tables for the report.
Keys list_keys(const std::shared_ptr<const toml::table>& file);
/// Spells the values as in TOML. Omits keys that have no effect on results.
std::map<std::string, std::string> spell_keys(const Keys& keys);

/// The files that a point reads, such as scene, network and routes. Omits the file of the machine
/// model.
std::vector<std::string> files_of(const Experiment& experiment);

/// The section [uncertain]: repeats the simulation on randomly varied machines.
struct Uncertain {
  /// number of machines whose model entries are drawn at random from their ranges; 0: none
  std::int64_t machines = 0;
  std::int64_t seed = 1;
};

/// Description of a key of the experiment file, for help texts.
struct Setting {
  /// Dotted name, "scene.objects". An axis of [sweep] may use its last part only, "objects". Names
  /// of model entries begin with "model.", as in "model.link.one_way_rate".
  std::string key;
  std::string help, unit = {};
  base::Domain domain = {base::Domain::Kind::any};
  base::Scalar standard = {};  ///< the default
};
/// Formats a default for help texts; a flag's default is "true" or "false".
std::string describe_default(const base::Domain& domain, const base::Scalar& standard);
/// The keys that do not depend on the program.
std::vector<Setting> settings();

/// Appends a setting for each field of P. Its default is the field's value in `params`.
template <class P>
void add_settings(std::vector<Setting>& all, const base::Fields<P>& fields,
                  const std::string& prefix, const P& params = {}) {
  for (const auto& f : fields)
    all.push_back({prefix + f.name, f.help, f.unit, f.domain, f.get(params)});
}

/// An axis of [sweep].
struct Axis {
  std::string name;  ///< name of the axis and of its result column, "objects"
  std::string key;   ///< dotted key that the axis sets, "scene.objects"
  std::vector<Node> values;
};
/// Axes that change together, as in "workers, height" = [[1, 16], ...]. An axis that changes alone
/// is a list of one axis.
using Coupled = std::vector<Axis>;

/// The value of one axis at a point.
struct Coordinate {
  std::string axis, key;  ///< the members `name` and `key` of the Axis
  Node value;
};

/// One point of a sweep: a combination of axis values, and the settings that result.
struct Point {
  std::vector<Coordinate> at;  ///< values of the axes of [sweep], in their order
  Experiment experiment;
  /// The numbers that the file assigns to keys, such as "image.width" -> 100. Omits defaults.
  std::map<std::string, double, std::less<>> numbers;
};

/// Formats the axis values of a point: "objects = 200, workers = 3". Returns "" for the only point
/// of a file without a sweep.
std::string name_of(const Point& point);

struct ExperimentFile {
  /// path of the file as the user spelled it, relative to the current folder when it was loaded
  std::string path;
  std::string folder;  ///< folder that paths in the file are relative to; "": the current folder
  std::shared_ptr<const toml::table> content;  ///< the file after applying --set
  std::vector<Coupled> sweep;                  ///< the axes of [sweep]
  /// all points of the sweep; the last axis varies fastest; a file without a sweep has one point
  std::vector<Point> points;
  Keys keys;
  std::vector<Definition> definitions;  ///< names of [let] with their expressions
  std::vector<Check> checks;            ///< checks, from [[check]]
  std::vector<PlotSpec> plots;          ///< plots, from [[plot]]
  std::vector<BestSpec> bests;          ///< questions for the best values, from [[best]]
  std::vector<BaselineSpec> baselines;  ///< baselines of speed-ups, from [[baseline]]
  ReportSpec report;                    ///< contents of the report, from [report]
  Uncertain uncertain;                  ///< number of machines to draw at random, from [uncertain]

  /// All axes of the sweep, in their order.
  auto axes() const { return sweep | std::views::join; }
};

/// A value that replaces the value of a key in the file, as with the option --set.
struct Override {
  std::string key;  ///< dotted key, "scene.objects"; for an axis "sweep.workers"
  Node value;
  std::string spelled = {};  ///< the user's argument of --set; "" if tlab itself set the value

  /// Spells the override as an argument of --set.
  std::string text() const;
};
using Overrides = std::vector<Override>;

/// Reads "key.path=value". A value that is not valid TOML counts as a string. Throws BadInput.
Override parse_override(const std::string& text);

/// Formats the content of a file as TOML, with the axes of [sweep] in their order.
std::string resolve(const ExperimentFile& file);

/// The path of an experiment file, or the path and a text that is read instead of the file.
struct ExperimentSource {
  ExperimentSource(const std::string& path);
  /// Paths in the text are relative to `folder`.
  ExperimentSource(std::string text, std::string path, std::string folder)
      : path(std::move(path)), folder(std::move(folder)), text(std::move(text)) {}

  std::string path, folder;
  std::optional<std::string> text;  ///< replaces the content of the file
};

/// Reads and checks an experiment. First applies the values of [reduced] if `is_reduced`, then
/// `overrides`. Throws BadInput with the file, the line or key, the value found, and the nearest
/// valid name.
ExperimentFile load_experiment(const ExperimentSource& source, const Overrides& overrides,
                               bool is_reduced = false);

}  // namespace laboratory

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

/// A TOML value that outlives the table that contains it.
using Node = std::shared_ptr<const toml::node>;
/// Makes a truth value, a number, a text or a list of texts.
Node make_node(const base::Scalar& value);

/// A [[fault]] with its position in the file, "e.toml:12: [[fault]] 2".
struct FaultSpec {
  programs::PlannedFault fault;
  std::string place;
};

/// A machine model, by name or from a file, with the entries that the experiment overrides.
struct ModelSpec {
  base::Source source;
  machine::Overrides entries = {};
};

/// A [[processor]]: a processor of the topology whose model differs from the machine's.
struct OtherProcessor {
  int number = 0;
  ModelSpec model;
  std::string place;  ///< position for errors, "e.toml:12: [[processor]] 2"
};

/// The settings of one run: every key of the file with its value or default. Paths are relative to
/// the current folder. Strings keep the file's spelling.
struct Experiment {
  std::string title, question;
  const programs::Program* program = nullptr;  ///< program that the key program.name selects
  std::any params;                             ///< parameters of the program
  /// model of the machine, from machine.model and [model]
  ModelSpec model{{"t805-25", "t805-25"}};
  std::vector<OtherProcessor> others;     ///< processors with other models, from [[processor]]
  base::Source topology{"tree", "tree"};  ///< generator (sized by `workers`), specification or file
  std::int64_t workers = 7;               ///< number of processors in the network
  int switches = 0;  ///< C004 link switches on every link not listed in `switches_between`
  /// three numbers: two processors, counted from 0, and the switches on the links between them
  std::vector<std::array<int, 3>> switches_between;
  base::Source routes;  ///< "xy", or a file with some of the routes; "": shortest routes
  /// broadcast trees, "per_root" or "single"; "": single if tree_links are given, else per_root
  std::string tree;
  /// links of the single tree; none: breadth-first tree of the root
  topologies::TreeLinks tree_links;
  std::vector<FaultSpec> faults;  ///< faults from [[fault]]
  std::int64_t repetitions = 1;   ///< number of seeds, which become an axis of the sweep
  bool is_timed = false;          ///< true if the key run.cost is "timed"
  machine::EngineParams engine;   ///< from the keys run.engine and run.processes
  /// host speed for timed costs, cycles per host second, once it is known
  std::optional<double> cycles_per_host_s = {};
};

/// The keys of a file that concern single points, by their dotted names, with their values.
using Keys = std::map<std::string, Node>;
/// Lists them. Omits [sweep], [let], [[check]] and the tables for the report.
Keys list_keys(const std::shared_ptr<const toml::table>& file);
/// The values as spelled in TOML, without keys that do not change results.
std::map<std::string, std::string> spell_keys(const Keys& keys);

/// The files that a point reads, such as scene, network and routes, without the machine model.
std::vector<std::string> files_of(const Experiment& experiment);

/// The section [uncertain].
struct Uncertain {
  /// number of machines drawn at random from the ranges of the model's entries; 0: none
  std::int64_t machines = 0;
  std::int64_t seed = 1;
};

/// A key of the experiment file, for help.
struct Setting {
  /// Dotted name: "scene.objects". As an axis of [sweep], its last part is enough: "objects".
  /// Entries of the model have the prefix "model", as in "model.link.one_way_rate".
  std::string key;
  std::string help, unit = {};
  base::Domain domain = {base::Domain::Kind::any};
  base::Scalar standard = {};  ///< the default
};
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
/// Coupled axes, as in "workers, height" = [[1, 16], ...]. A single axis is a list of one.
using Coupled = std::vector<Axis>;

/// The value of one axis at a point.
struct Coordinate {
  std::string axis, key;  ///< as of the Axis
  Node value;
};

/// One point of a sweep.
struct Point {
  std::vector<Coordinate> at;  ///< values of the axes of [sweep], in their order
  Experiment experiment;
  /// The numbers that the file assigns to keys, such as "image.width" -> 100, without defaults.
  std::map<std::string, double, std::less<>> numbers;
};

/// Formats the axes of a point: "objects = 200, workers = 3". For the only point of a file without
/// a sweep, the result is "".
std::string name_of(const Point& point);

struct ExperimentFile {
  /// path of the file as the user spelled it, relative to the current folder at that time
  std::string path;
  std::string folder;  ///< folder that paths in the file are relative to; "": the current folder
  std::shared_ptr<const toml::table> content;  ///< the file after applying --set
  std::vector<Coupled> sweep;                  ///< the axes of [sweep]
  /// all points, the last axis varying fastest; a file without a sweep has one point
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

/// A value that replaces that of a key.
struct Override {
  std::string key;  ///< dotted key, "scene.objects"; for an axis "sweep.workers"
  Node value;
  std::string spelled = {};  ///< text that the user gave to --set; "" if tlab itself set the value

  /// The override as an argument of --set.
  std::string text() const;
};
using Overrides = std::vector<Override>;

/// Reads "key.path=value". A value that is not valid TOML counts as a string. Throws BadInput.
Override parse_override(const std::string& text);

/// Formats the content of a file as TOML, with the axes in the order of the sweep.
std::string resolve(const ExperimentFile& file);

/// An experiment file, or a text in its place.
struct ExperimentSource {
  ExperimentSource(const std::string& path);
  /// Paths in the text are relative to `folder`.
  ExperimentSource(std::string text, std::string path, std::string folder)
      : path(std::move(path)), folder(std::move(folder)), text(std::move(text)) {}

  std::string path, folder;
  std::optional<std::string> text;  ///< replaces the content of the file
};

/// Reads and checks an experiment. Applies the values of [reduced] if `is_reduced`, then
/// `overrides`. Throws BadInput with the file, the line or key, the value found, and the nearest
/// valid key.
ExperimentFile load_experiment(const ExperimentSource& source, const Overrides& overrides,
                               bool is_reduced = false);

}  // namespace laboratory

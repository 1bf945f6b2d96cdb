#pragma once
// Declaration of a program: parameters, required parts of the experiment, measured results, and the
// function that runs it. The laboratory, which runs experiments, knows programs only through their
// declarations.
#include <any>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/fields.hpp"
#include "simulator/observe/run_monitor.hpp"
#include "simulator/observe/use.hpp"
#include "simulator/programs/declare/faults.hpp"
#include "simulator/programs/declare/other_models.hpp"
#include "topologies/graph/topology.hpp"
#include "topologies/route/routes.hpp"

namespace programs {

using base::column;
using base::Row;

/// Arguments of a program's run, in addition to its parameters.
struct Setup {
  const machine::Model& model;
  topologies::Topology topology;           ///< a single processor if the program uses no network
  observe::RunMonitor* monitor = nullptr;  ///< time limit and trace of the run; may be null
  topologies::RoutingTable routes = {};    ///< empty unless the program declares Uses::routes
  /// Tree for broadcasts of all processors; if absent, each sender has a tree of its own.
  std::optional<topologies::TreeLinks> tree = {};
  std::vector<PlannedFault> faults = {};  ///< empty unless the program declares Uses::faults
  /// If set, kernels are charged their host time, converted with this factor in cycles per second.
  std::optional<double> cycles_per_host_s = {};
  bool profile = false;  ///< if true, measures the host time of kernels
  machine::EngineParams engine = {};
  OtherModels others = {};  ///< empty unless the program declares Uses::others

  const machine::Model& model_of(int id) const { return programs::model_of(others, id, model); }
};

/// A computed picture. When a run is repeated, `save` writes the same bytes.
struct Image {
  std::string name;            ///< unique name of letters, digits and "-", such as "picture"
  std::optional<double> at_s;  ///< for an intermediate picture: time in s at which it was complete
  std::function<void(const std::string& path)> save;  ///< writes a file of the type `extension`
  /// Writes an OpenEXR file, whose colours are not clipped.
  std::function<void(const std::string& path)> save_exr = nullptr;
  /// If true, the file name does not contain the point of the sweep, unless several images have the
  /// same name.
  bool is_named = false;
  const char* extension = ".png";  ///< extension of the file that `save` writes
};

/// Load of a resource and the reason for it.
struct Load {
  std::string resource;
  double busy = 0;    ///< fraction of the time in which the resource is busy, 0 to 1
  std::string doing;  ///< reason for the load, as a sentence
};

/// Results of a run in addition to its rows.
struct Extras {
  std::vector<std::string> notes = {};  ///< sentences about the run
  std::vector<Image> images = {};
  std::vector<Row> growth = {};     ///< rows of growth.csv: quality of the picture over time
  std::vector<Row> histogram = {};  ///< rows of histogram.csv (observe::make_rows)
  /// Reason for the end of the run. Unless it is `done`, the rows describe the time up to this end.
  machine::End end = machine::End::done;
  bool is_saturated = false;             ///< true if queues grow without bound
  std::optional<observe::Use> use = {};  ///< use of processors and links, for run.json
  std::vector<Load> loads = {};
  std::uint64_t events = 0;                  ///< number of simulated events, if counted
  std::optional<double> kernel_host_s = {};  ///< host time of kernels in s; only if Setup::profile
  std::vector<observe::KernelUse> kernels = {};  ///< only if costs are host times
};

/// Results of a run: one or several rows. If several, the columns named in Program::parts tell them
/// apart.
template <class R>
struct Outcome : Extras {
  std::vector<R> rows;

  Outcome() = default;
  Outcome(R row) { rows.push_back(std::move(row)); }
  explicit Outcome(std::vector<R> all, std::vector<std::string> sentences = {})
      : Extras{std::move(sentences)}, rows(std::move(all)) {}
};

using Parameter = base::Field<std::any>;

/// A list of tables in the experiment file, such as [[stage]]. Each table is one record of the
/// list.
struct RecordList {
  std::string key, help;
  std::vector<Parameter> fields;  ///< fields of a record
  std::function<std::any()> make_record;
  std::function<void(std::any& params)> clear;
  /// Appends the record to the list. Throws BadInput if its fields are unknown or missing.
  std::function<void(std::any& params, const std::any& record)> append;
};

/// Name and meaning of a column in a program's table of results, for the manual.
struct ColumnHelp {
  std::string name, help;
};

/// The optional parts of an experiment that a program uses. If a program does not use a part, the
/// experiment must not contain it.
struct Uses {
  bool network = false;  ///< the program uses the section [network]
  bool routes = false;   ///< the program uses the routes and trees of [network]
  bool faults = false;   ///< the program uses the list [[fault]]
  bool timed = false;    ///< the program can charge host times: run.cost = "timed"
  bool others = false;   ///< the program uses the list [[processor]]
  /// The program can run with --threads, because its processors share only constant data.
  bool threads = false;
};

/// A plot in the reports of experiments that declare no plots of their own: a result over the axes
/// of the sweep.
struct UsualPlot {
  std::string column, title;
};

/// A drawing of the network that shows the loads of processors and links.
struct NetworkDrawing {
  /// A processor that is not part of the topology.
  struct Outsider {
    std::string name;
    /// The processor to which this one is linked: an earlier outsider, or "" for the topology's
    /// root.
    std::string to = {};
  };
  /// Returns the name, in observe::Use, of a processor of the topology.
  std::string (*name)(const topologies::Topology& topology, int id);
  std::vector<Outsider> outsiders = {};
};

/// The columns of a program whose queues grow without bound if its load is too high.
struct SaturationColumns {
  std::string mark;        ///< result: not 0 for a point beyond saturation
  std::string load;        ///< parameter: the offered load
  std::string bound;       ///< result: upper bound of the load; may be empty
  std::string bound_name;  ///< meaning of the bound: "bound by the busiest link"

  bool operator==(const SaturationColumns&) const = default;
};

/// Which results of a program are shown in tables and reports. The defaults also apply to
/// experiments that run several programs.
struct Shows {
  /// Columns that come first, even if they are not axes of the sweep.
  std::vector<std::string> leading = {};
  std::vector<std::string> summary = {};  ///< results shown in short tables; if empty, all
  std::vector<std::string> loads = {};    ///< columns of a second table; if empty, there is none
  std::vector<UsualPlot> plots = {};      ///< if empty, a plot of the first result
  std::optional<NetworkDrawing> network = {};        ///< if absent, the network is not drawn
  std::vector<std::string> histograms = {};          ///< quantities in histogram.csv
  std::optional<SaturationColumns> saturation = {};  ///< if absent, no point is beyond saturation
};

/// A program. Its parameters are stored in a std::any, because their type differs between programs.
struct Program {
  std::string name, help;
  Uses uses;
  std::vector<std::string> parts;  ///< columns that tell the rows of one run apart
  std::vector<Parameter> parameters;
  std::vector<RecordList> lists = {};
  std::vector<ColumnHelp> columns;
  std::any defaults;
  std::function<Outcome<Row>(const Setup&, const std::any&)> run;
  /// Checks parameters beyond their ranges, before anything runs. Throws BadInput.
  std::function<void(const Setup&, const std::any&)> check;
  /// Columns whose values are known before a run. Tables show them beside the axes of the sweep.
  std::function<Row(const std::any&)> describe = {};
  /// Returns a key. Runs with equal keys must produce equal images. If the function is empty,
  /// images are not compared.
  std::function<std::string(const std::any&)> picture_key = {};
  bool shows_picture = false;  ///< true if the picture can be watched during the run
  /// Returns the parameter whose value makes the parameter `key` irrelevant, or "" if there is
  /// none. An irrelevant parameter cannot be an axis of a sweep.
  std::function<std::string(const std::any&, const std::string& key)> voids = {};
  /// Name of the column that holds the number of working processors.
  std::string processors = "processors";
  /// Number of processors that the column `processors` does not count.
  int services = 0;
  bool shows_parameters = true;  ///< if true, each parameter is a column of the results
  Shows shows = {};

  const Parameter* find(std::string_view name) const;  ///< null if there is none
  const RecordList* find_list(std::string_view key) const;
};

/// The key of a parameter in the experiment file. This is its name if the name contains a section,
/// otherwise "program." followed by its name.
std::string key_of(const Parameter& parameter);

/// Declaration of a program with parameters of type P and results of type R. Only name, help and
/// run are required.
template <class P, class R>
struct Declaration {
  std::string name, help;
  Uses uses = {};
  base::Fields<P> fields = {};
  base::Columns<R> columns = {};
  std::vector<std::string> parts = {};
  std::function<Outcome<R>(const Setup&, const P&)> run;
  std::function<void(const Setup&, const P&)> check = {};
  std::function<Row(const P&)> describe = {};
  std::vector<RecordList> lists = {};
  Shows shows = {};
  std::function<std::string(const P&)> picture_key = {};
  std::function<std::string(const P&, const std::string& key)> voids = {};
};

template <class P, class R>
Program make_program(const Declaration<P, R>& d) {
  Program program{d.name, d.help, d.uses, d.parts, {}, d.lists, {}, P{}, {}, {}};
  constexpr base::AnyAs<P> params;
  program.parameters = base::lift_all<std::any>(d.fields, params);
  for (const auto& c : d.columns) program.columns.push_back({c.name, c.help});
  if (d.run)
    program.run = [run = d.run, columns = d.columns, params](const Setup& setup,
                                                             const std::any& any) {
      auto found = run(setup, params(any));
      Outcome<Row> outcome;
      for (const auto& row : found.rows) outcome.rows.push_back(base::make_row(columns, row));
      static_cast<Extras&>(outcome) = std::move(found);
      return outcome;
    };
  if (d.check)
    program.check = [check = d.check, params](const Setup& setup, const std::any& any) {
      check(setup, params(any));
    };
  const auto erase = [params](const auto& of) {
    return [of, params](const std::any& any, const auto&... others) {
      return of(params(any), others...);
    };
  };
  if (d.describe) program.describe = erase(d.describe);
  if (d.picture_key) program.picture_key = erase(d.picture_key);
  if (d.voids) program.voids = erase(d.voids);
  program.shows = d.shows;
  return program;
}

/// Thrown if a run was interrupted before it had any measurements.
struct Unfinished : machine::Fault {
  using Fault::Fault;
};

/// Runs a program's machine to its end. A live page shows `view`. Throws Unfinished and the
/// exceptions of the simulation.
void run_machine(const Setup& setup, machine::Machine& machine,
                 const observe::ControlPanel& view = {});
/// Does the same as run_machine for a program that does not end by itself: runs it up to `date`.
void run_machine_until(const Setup& setup, machine::Machine& machine, machine::Seconds date,
                       const observe::ControlPanel& view = {});

}  // namespace programs

#pragma once
// Declaration of a program: parameters, requirements, measured results and run function. The
// laboratory knows programs only through these declarations.
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

/// Environment of a program's run, in addition to its parameters.
struct Setup {
  const machine::Model& model;
  topologies::Topology topology;           ///< a single processor if the program uses no network
  observe::RunMonitor* monitor = nullptr;  ///< limit and trace of the run; may be null
  topologies::RoutingTable routes = {};    ///< empty unless Uses::routes
  std::optional<topologies::TreeLinks> tree = {};  ///< broadcast tree; default: one per sender
  std::vector<PlannedFault> faults = {};           ///< empty unless Uses::faults
  std::optional<double> cycles_per_host_s = {};    ///< cycles charged per second of host time
  bool profile = false;                            ///< true: measure the host time of kernels
  machine::EngineParams engine = {};
  OtherModels others = {};  ///< empty unless Uses::others

  const machine::Model& model_of(int id) const { return programs::model_of(others, id, model); }
};

/// A computed picture. Equal runs save equal bytes.
struct Image {
  std::string name;            ///< such as "picture": unique letters, digits and "-"
  std::optional<double> at_s;  ///< completion time of an intermediate picture
  std::function<void(const std::string& path)> save;  ///< writes the format of `extension`
  /// Writes the full range as OpenEXR.
  std::function<void(const std::string& path)> save_exr = nullptr;
  /// True: the file name omits the sweep's point unless several images have the same name.
  bool is_named = false;
  const char* extension = ".png";  ///< extension of the file that `save` writes
};

/// Load of a resource and its cause.
struct Load {
  std::string resource;
  double busy = 0;    ///< fraction of the time
  std::string doing;  ///< cause of the load, as a sentence
};

/// Results of a run in addition to its rows.
struct Extras {
  std::vector<std::string> notes = {};  ///< sentences about the run
  std::vector<Image> images = {};
  std::vector<Row> growth = {};           ///< rows of growth.csv: the picture's quality over time
  machine::End end = machine::End::done;  ///< if not `done`, the rows cover the run up to this end
  bool is_saturated = false;              ///< true: queues grow without bound
  std::optional<observe::Use> use = {};   ///< use of resources, for run.json
  std::vector<Load> loads = {};
  std::uint64_t events = 0;                      ///< number of simulated events, if counted
  std::optional<double> kernel_host_s = {};      ///< host time of kernels, only with Setup::profile
  std::vector<observe::KernelUse> kernels = {};  ///< filled only for timed costs
};

/// Results of a run: one row, or several rows that are distinguished by the columns in
/// Program::parts.
template <class R>
struct Outcome : Extras {
  std::vector<R> rows;

  Outcome() = default;
  Outcome(R row) { rows.push_back(std::move(row)); }
  explicit Outcome(std::vector<R> all, std::vector<std::string> sentences = {})
      : Extras{std::move(sentences)}, rows(std::move(all)) {}
};

using Parameter = base::Field<std::any>;

/// A list of tables in the experiment file, such as [[stage]]. Each table is a record.
struct RecordList {
  std::string key, help;
  std::vector<Parameter> fields;  ///< the fields of a record
  std::function<std::any()> make_record;
  std::function<void(std::any& params)> clear;
  /// Appends the record to the list. Throws BadInput if entries are unknown or missing.
  std::function<void(std::any& params, const std::any& record)> append;
};

/// A column in a program's table of results, for the manual.
struct ColumnHelp {
  std::string name, help;
};

/// The optional parts of an experiment that a program uses. The experiment must not contain other
/// parts.
struct Uses {
  bool network = false;  ///< the program uses [network]
  bool routes = false;   ///< the program uses routes and trees of [network]
  bool faults = false;   ///< the program uses [[fault]]
  bool timed = false;    ///< the program supports run.cost = "timed"
  bool others = false;   ///< the program uses [[processor]]
  bool threads = false;  ///< supports --threads: processors share only constant data on the host
};

/// A plot that reports show by default: a result over the axes of the sweep.
struct UsualPlot {
  std::string column, title;
};

/// A drawing of the network with the loads of processors and links.
struct NetworkDrawing {
  /// A processor outside the topology.
  struct Outsider {
    std::string name;
    std::string to = {};  ///< the processor that it is linked to: an earlier outsider; "": the root
  };
  /// Name of a processor of the topology in Use.
  std::string (*name)(const topologies::Topology& topology, int id);
  std::vector<Outsider> outsiders = {};
};

/// What tables and reports show of a program's results. Each default applies also to experiments
/// with several programs.
struct Shows {
  std::vector<std::string> leading = {};  ///< columns that come first, even if they are not axes
  std::vector<std::string> summary = {};  ///< results in short tables; default: all
  std::vector<std::string> loads = {};    ///< columns of a second table; default: no such table
  std::vector<UsualPlot> plots = {};      ///< default: a plot of the first result
  std::optional<NetworkDrawing> network = {};  ///< default: no drawing
};

/// A program whose parameters are stored in a std::any.
struct Program {
  std::string name, help;
  Uses uses;
  std::vector<std::string> parts;  ///< columns that distinguish the rows of one run
  std::vector<Parameter> parameters;
  std::vector<RecordList> lists = {};
  std::vector<ColumnHelp> columns;
  std::any defaults;
  std::function<Outcome<Row>(const Setup&, const std::any&)> run;
  /// Checks that go beyond the ranges of parameters, before anything runs. Throws BadInput.
  std::function<void(const Setup&, const std::any&)> check;
  /// Columns that are known before a run. Tables show them with the axes.
  std::function<Row(const std::any&)> describe = {};
  /// Points with equal keys must produce equal images. Without this function, images are not
  /// compared.
  std::function<std::string(const std::any&)> picture_key = {};
  bool shows_picture = false;  ///< the picture is visible during the run
  /// Returns the parameter whose value makes `key` irrelevant, or "" if there is none. An
  /// irrelevant key cannot be an axis.
  std::function<std::string(const std::any&, const std::string& key)> voids = {};
  /// Name of the column with the number of working processors.
  std::string processors = "processors";
  int services = 0;              ///< number of service processors, not counted in this column
  bool shows_parameters = true;  ///< true: each parameter is a column of the results
  Shows shows = {};

  const Parameter* find(std::string_view name) const;  ///< null if there is none
  const RecordList* find_list(std::string_view key) const;
};

/// The key of a parameter in the experiment file: its name if that contains a section, otherwise
/// "program." and its name.
std::string key_of(const Parameter& parameter);

/// A program with typed parameters P and results R. Only name, help and run are required.
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

/// Thrown if a run was interrupted and has no measurements.
struct Unfinished : machine::Fault {
  using Fault::Fault;
};

/// Runs a program's machine to its end. `view` is shown by a live page. Throws Unfinished and the
/// exceptions of the simulation.
void run_machine(const Setup& setup, machine::Machine& machine,
                 const observe::ControlPanel& view = {});
/// Like run_machine, for a program without an end: runs it up to `date`.
void run_machine_until(const Setup& setup, machine::Machine& machine, machine::Seconds date,
                       const observe::ControlPanel& view = {});

}  // namespace programs

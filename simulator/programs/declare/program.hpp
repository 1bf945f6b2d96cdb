#pragma once
// Declaration of a program: parameters, needs, measured results and run function. The laboratory
// knows programs only by these declarations.
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

/// Environment of a program's run, beside its parameters.
struct Setup {
  const machine::Model& model;
  topologies::Topology topology;           ///< one processor if the program uses no network
  observe::RunMonitor* monitor = nullptr;  ///< limit and trace of the run; may be null
  topologies::RoutingTable routes = {};    ///< only with Uses::routes
  std::optional<topologies::TreeLinks> tree =
      {};                                        ///< tree for messages to all; none: one per sender
  std::vector<PlannedFault> faults = {};         ///< only with Uses::faults
  std::optional<double> cycles_per_host_s = {};  ///< for timed costs: charge host time
  bool profile = false;                          ///< measure the host time of kernels
  machine::EngineParams engine = {};
  OtherModels others = {};  ///< only with Uses::others

  const machine::Model& model_of(int id) const { return programs::model_of(others, id, model); }
};

/// A computed picture: equal runs give equal bytes.
struct Image {
  std::string name;            ///< "picture"; unique in the run; letters, digits and "-"
  std::optional<double> at_s;  ///< date of completion, for an intermediate picture
  std::function<void(const std::string& path)> save;  ///< in the format of `extension`
  std::function<void(const std::string& path)> save_exr = nullptr;  ///< the same in full range
  bool is_named = false;           ///< add the sweep's point only if another image has this name
  const char* extension = ".png";  ///< of the file that `save` writes; ".webp" for an animation
};

/// Load of a resource, with its cause.
struct Load {
  std::string resource;
  double busy = 0;    ///< share of the time
  std::string doing;  ///< a sentence
};

/// Results of a run beside its rows.
struct Extras {
  std::vector<std::string> notes = {};  ///< sentences about the run
  std::vector<Image> images = {};
  std::vector<Row> growth = {};           ///< rows of growth.csv: progress of the picture
  machine::End end = machine::End::done;  ///< if not done: rows are measured up to this end
  bool is_saturated = false;              ///< queues grow without bound
  std::optional<observe::Use> use = {};   ///< use of the resources, for run.json
  std::vector<Load> loads = {};
  std::uint64_t events = 0;                      ///< simulated events, if counted
  std::optional<double> kernel_host_s = {};      ///< only with Setup::profile
  std::vector<observe::KernelUse> kernels = {};  ///< only for timed costs
};

/// Results of a run: a row, or several that differ in the columns of Program::parts.
template <class R>
struct Outcome : Extras {
  std::vector<R> rows;

  Outcome() = default;
  Outcome(R row) { rows.push_back(std::move(row)); }
  explicit Outcome(std::vector<R> all, std::vector<std::string> sentences = {})
      : Extras{std::move(sentences)}, rows(std::move(all)) {}
};

using Parameter = base::Field<std::any>;

/// A list of tables in the experiment file, such as [[stage]]; each table is a record.
struct RecordList {
  std::string key, help;
  std::vector<Parameter> fields;  ///< a record's fields
  std::function<std::any()> make_record;
  std::function<void(std::any& params)> clear;
  /// Throws BadInput for a record with superfluous or missing entries.
  std::function<void(std::any& params, const std::any& record)> append;
};

/// A column of a program's table, for the manual.
struct ColumnHelp {
  std::string name, help;
};

/// Optional parts of an experiment that a program uses. The experiment may not contain others.
struct Uses {
  bool network = false;  ///< [network]
  bool routes = false;   ///< routes and trees of [network]
  bool faults = false;   ///< [[fault]]
  bool timed = false;    ///< run.cost = "timed"
  bool others = false;   ///< [[processor]]
  bool threads = false;  ///< --threads: data shared by its processors on the host is constant
};

/// A program with its parameters in a std::any.
struct Program {
  std::string name, help;
  Uses uses;
  std::vector<std::string> parts;  ///< columns that distinguish the rows of a run
  std::vector<Parameter> parameters;
  std::vector<RecordList> lists = {};
  std::vector<ColumnHelp> columns;
  std::any defaults;
  std::function<Outcome<Row>(const Setup&, const std::any&)> run;
  /// Checks beyond the parameters' ranges, before anything runs. Throws BadInput.
  std::function<void(const Setup&, const std::any&)> check;
  /// Columns known before a run; they belong to the axes.
  std::function<Row(const std::any&)> describe = {};
  /// Points with equal keys must have equal images; none: no such check.
  std::function<std::string(const std::any&)> picture_key = {};
  bool shows_picture = false;  ///< during the run: observe::ControlPanel::picture
  /// The parameter that makes `key` void here, so that `key` cannot be an axis; "": none.
  std::function<std::string(const std::any&, const std::string& key)> voids = {};
  std::string processors = "processors";  ///< column with the number of working processors
  int services = 0;              ///< processors of the network that serve others, not counted there
  bool shows_parameters = true;  ///< each parameter is a column of the results
  /// Columns that always come first, even if they are no axes of the sweep.
  std::vector<std::string> leading = {};

  const Parameter* find(std::string_view name) const;
};

/// The key of a parameter in the experiment file: "program.bytes", unless its name has a section.
std::string key_of(const Parameter& parameter);

/// A program with parameters P and results R, before type erasure. Only name, help and run are
/// required.
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
  if (d.describe)
    program.describe = [describe = d.describe, params](const std::any& any) {
      return describe(params(any));
    };
  return program;
}

/// A run was interrupted without a measurement.
struct Unfinished : machine::Fault {
  using Fault::Fault;
};

/// Runs a program's machine to its end. Throws Unfinished, and exceptions of the simulation. A live
/// page shows `view`.
void run_machine(const Setup& setup, machine::Machine& machine,
                 const observe::ControlPanel& view = {});
/// The same for an endless program, up to a date.
void run_machine_until(const Setup& setup, machine::Machine& machine, machine::Seconds date,
                       const observe::ControlPanel& view = {});

}  // namespace programs

#pragma once
// How a program declares itself: its parameters, what it needs, what it measures and how it runs.
// The laboratory knows programs only by these declarations.
#include <any>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/fields.hpp"
#include "simulator/declare/faults.hpp"
#include "simulator/declare/other_models.hpp"
#include "simulator/observe/use.hpp"
#include "simulator/observe/watch.hpp"
#include "topologies/graph/topology.hpp"
#include "topologies/route/routes.hpp"

namespace programs {

using base::column;
using base::Row;

/// What a program runs on, beside its parameters.
struct Setup {
  const machine::Model& model;
  topologies::Topology topology;         ///< one processor where the program uses no network
  observe::Watch* watch = nullptr;       ///< its limit and trace, if there is one
  topologies::RoutingTable routes = {};  ///< where the program uses routes
  std::optional<topologies::TreeLinks> tree =
      {};                                 ///< way of messages to all; none: each sender has one
  std::vector<PlannedFault> faults = {};  ///< where the program uses faults
  std::optional<double> cycles_per_host_s = {};  ///< where costs are timed: charge host time
  bool profile = false;                          ///< measure the host time of kernels
  machine::EngineParams engine = {};
  OtherModels others = {};  ///< where the program uses them

  const machine::Model& model_of(int id) const { return programs::model_of(others, id, model); }
};

/// A picture of what was computed: equal runs give equal bytes.
struct Image {
  std::string name;  ///< "picture"; no other image of the run has it; letters, digits and "-"
  std::optional<double> at_s;  ///< when it was complete, for one on the way to the last
  std::function<void(const std::string& path)> save;                ///< as `extension` says
  std::function<void(const std::string& path)> save_exr = nullptr;  ///< the same, all its range
  bool is_named = false;  ///< the name says already what it shows; else points are told apart
  const char* extension = ".png";  ///< of what `save` writes; ".webp" for a moving picture
};

/// How busy a resource was, and what with.
struct Load {
  std::string resource;
  double busy = 0;    ///< share of the time
  std::string doing;  ///< a sentence
};

/// What a run gives beside its rows.
struct Extras {
  std::vector<std::string> notes = {};  ///< sentences about the run
  std::vector<Image> images = {};
  std::vector<Row> growth = {};           ///< rows of growth.csv: how the picture became what it is
  machine::End end = machine::End::done;  ///< else the row is what was measured until then
  bool is_saturated = false;              ///< queues grow without bound
  std::optional<observe::Use> use = {};   ///< what was busy, for run.json
  std::vector<Load> loads = {};
  std::uint64_t events = 0;                      ///< simulated, where they are counted
  std::optional<double> kernel_host_s = {};      ///< with Setup::profile
  std::vector<observe::KernelUse> kernels = {};  ///< where costs are timed
};

/// What a run gives: a row, or several that differ in the columns of Program::parts.
template <class R>
struct Outcome : Extras {
  std::vector<R> rows;

  Outcome() = default;
  Outcome(R row) { rows.push_back(std::move(row)); }
  explicit Outcome(std::vector<R> all, std::vector<std::string> sentences = {})
      : Extras{std::move(sentences)}, rows(std::move(all)) {}
};

using Parameter = base::Field<std::any>;

/// A list of tables of the experiment file, [[stage]]: each is a record of its own.
struct RecordList {
  std::string key, help;
  std::vector<Parameter> fields;  ///< a record's fields
  std::function<std::any()> make_record;
  std::function<void(std::any& params)> clear;
  /// Throws BadInput for a record that says too much or too little.
  std::function<void(std::any& params, const std::any& record)> append;
};

/// A column of a program's table, for the manual.
struct ColumnHelp {
  std::string name, help;
};

/// What a program needs beside its parameters. The experiment may speak only of what it uses.
struct Uses {
  bool network = false;  ///< [network]
  bool routes = false;   ///< its routes and trees
  bool faults = false;   ///< [[fault]]
  bool timed = false;    ///< run.cost = "timed"
  bool others = false;   ///< [[processor]]
  bool threads = false;  ///< --threads: what its processors share on the host does not change
};

/// A program, its parameters in a std::any.
struct Program {
  std::string name, help;
  Uses uses;
  std::vector<std::string> parts;  ///< columns that tell the rows of a run apart
  std::vector<Parameter> parameters;
  std::vector<RecordList> lists = {};
  std::vector<ColumnHelp> columns;
  std::any defaults;
  std::function<Outcome<Row>(const Setup&, const std::any&)> run;
  /// Throws BadInput for what the parameters' ranges do not tell, before anything runs.
  std::function<void(const Setup&, const std::any&)> check;
  /// Columns that are known before a run, and belong to the axes.
  std::function<Row(const std::any&)> describe = {};
  /// Points of equal keys must have equal images; none: nothing is known.
  std::function<std::string(const std::any&)> picture_key = {};
  bool shows_picture = false;  ///< while it runs: observe::View::picture
  /// The key that makes another one void at these parameters, which then can be no axis; "": none.
  std::function<std::string(const std::any&, const std::string& key)> voids = {};
  std::string processors = "processors";  ///< column of the number of processors that work
  int services = 0;  ///< processors of the network that serve the others and are not counted there
  bool shows_parameters = true;  ///< each is a column of the results
  /// Columns that come first whether they are axes of the sweep or not.
  std::vector<std::string> leading = {};

  const Parameter* find(std::string_view name) const;
};

/// The key of a parameter in the experiment file: "program.bytes", unless its name has a section.
std::string key_of(const Parameter& parameter);

/// A program of parameters P and results R, before their types are hidden. Only name, help and run
/// are needed.
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
  const auto params = [](std::any& any) -> P& { return std::any_cast<P&>(any); };
  const auto const_params = [](const std::any& any) -> const P& {
    return std::any_cast<const P&>(any);
  };
  program.parameters = base::lift_all<std::any>(d.fields, params);
  for (const auto& c : d.columns) program.columns.push_back({c.name, c.help});
  program.run = [run = d.run, columns = d.columns, const_params](const Setup& setup,
                                                                 const std::any& any) {
    auto found = run(setup, const_params(any));
    Outcome<Row> outcome;
    for (const auto& row : found.rows) outcome.rows.push_back(base::make_row(columns, row));
    static_cast<Extras&>(outcome) = std::move(found);
    return outcome;
  };
  if (d.check)
    program.check = [check = d.check, const_params](const Setup& setup, const std::any& any) {
      check(setup, const_params(any));
    };
  if (d.describe)
    program.describe = [describe = d.describe, const_params](const std::any& any) {
      return describe(const_params(any));
    };
  return program;
}

/// A run was cut short: nothing was measured.
struct Unfinished : machine::Fault {
  using Fault::Fault;
};

/// Runs a program's machine to its end. Throws Unfinished, and what the simulation throws. A
/// live page shows `view`.
void run_machine(const Setup& setup, machine::Machine& machine, const observe::View& view = {});
/// The same for a program without an end, up to a date.
void run_machine_until(const Setup& setup, machine::Machine& machine, machine::Seconds date,
                       const observe::View& view = {});

}  // namespace programs

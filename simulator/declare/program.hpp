#pragma once
// Patterns: small synthetic programs that show one property of the machine, to be compared with a
// formula. One file each: its processes, what it measures, and make_NAME() for the list.
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "simulator/machine/faults.hpp"
#include "simulator/machine/model.hpp"
#include "simulator/observe/watch.hpp"
#include "topologies/graph/topology.hpp"
#include "topologies/route/routes.hpp"
#include "topologies/route/tree_links.hpp"

namespace programs {

// A key of [program] beside its name, and a possible axis.
struct Parameter {
  std::string name;
  double value;      // where the experiment names none
  double low, high;  // its range, ends included
  bool whole;        // no fractions
  std::string help;  // what it is, with its unit
  // A named choice: a text of these in the experiment file, whose index is the value. Empty: a
  // number.
  std::vector<std::string> choices = {};
  bool is_path = false;      // the name of a file, relative to the experiment's folder; "": none
  bool is_required = false;  // of a path: none is an error
};

// A named choice; the first is the default.
Parameter make_choice(const std::string& name, const std::vector<std::string>& choices,
                      const std::string& help);
// A file; none is the default.
Parameter make_path(const std::string& name, const std::string& help, bool is_required = false);

// The value of a path.
struct NamedFile {
  std::string text;  // as the experiment spells it
  std::string path;  // where it is; "" for none
};

// What a run measured: columns of results.csv, their units in their names.
using Row = std::vector<std::pair<std::string, double>>;

// A picture of what was computed: equal runs give equal bytes.
struct Image {
  std::string name;            // "picture", of a run's images no other has it; letters, digits, "-"
  std::optional<double> at_s;  // when it was complete, of one on the way to the last
  std::function<void(const std::string& path)> save;                // as PNG
  std::function<void(const std::string& path)> save_exr = nullptr;  // the same with all its range
};

// What a run gives: a row; or several, told apart by the columns of Pattern::parts, which are in
// each of them.
struct Rows {
  std::vector<Row> rows;
  std::vector<std::string> notes = {};  // sentences about the run
  std::vector<Image> images = {};

  Rows() = default;
  Rows(Row row) : rows{std::move(row)} {}
  explicit Rows(std::vector<Row> rows, std::vector<std::string> notes = {})
      : rows(std::move(rows)), notes(std::move(notes)) {}
};

// What breaks while the program runs: the link between two processors, or a processor.
struct PlannedFault {
  double at_s = 0;
  int a = 0;
  int b = -1;  // none: the processor a

  bool operator==(const PlannedFault&) const = default;
};

struct Pattern;

// What a pattern runs on. Every parameter has a value, and it is in range.
struct Setup {
  const machine::Model& model;
  topologies::Topology topology;  // of one processor where the pattern uses none
  std::map<std::string, double, std::less<>> parameters;
  observe::Watch* watch = nullptr;   // its limit and trace, if there is one
  const Pattern* pattern = nullptr;  // whose parameters these are, for `choice`
  // Where the pattern uses routes.
  topologies::RoutingTable routes = {};
  std::optional<topologies::TreeLinks> tree = {};  // for messages to all; none: one of each sender
  std::vector<PlannedFault> faults = {};           // where the pattern uses them
  std::map<std::string, NamedFile, std::less<>> files = {};  // the parameters that are paths
  // Where the pattern uses costs, and they are those of the host: what its time is charged.
  std::optional<double> cycles_per_host_s = {};

  // Throw base::InvariantBroken for a parameter that the pattern does not have, and for a
  // number that is no choice.
  double operator[](std::string_view name) const;
  std::int64_t whole(std::string_view name) const;
  std::string choice(std::string_view name) const;
  const std::string& path(std::string_view name) const;  // "" for none
};

struct Pattern {
  std::string name, help;
  bool uses_topology;  // else the experiment may not name a network
  std::vector<Parameter> parameters;
  std::function<Rows(const Setup&)> run;  // throws what the simulation throws
  std::vector<std::string> parts = {};    // columns that tell the rows of a run apart
  bool uses_routes = false;               // else it may not name routes and tree of the network
  bool uses_faults = false;               // else it may have no [[fault]]
  bool uses_cost = false;                 // else run.cost may not be timed
  // Throws for what the parameters' ranges do not tell, before anything runs; none: all is well.
  // The topology is not the run's.
  std::function<void(const Setup&)> check = {};
};

// A run was cut short: nothing was measured.
struct Unfinished : machine::Fault {
  using Fault::Fault;
};

// Runs a pattern's machine to its end. Throws Unfinished, and what the simulation throws.
void run_machine(const Setup& setup, machine::Machine& machine);
// The same of a program without an end, up to a date.
void run_machine_until(const Setup& setup, machine::Machine& machine, machine::Seconds date);

// In the order of a help text.
const std::vector<Pattern>& all_patterns();

}  // namespace programs

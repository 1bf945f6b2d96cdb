#pragma once
// Patterns: small synthetic programs that show one property of the machine, to be compared with a
// formula. One file each: its processes, what it measures, and make_NAME() for the list.
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "simulator/machine/faults.hpp"
#include "simulator/machine/model.hpp"
#include "simulator/observe/watch.hpp"
#include "topologies/topology.hpp"

namespace patterns {

// A key of [program] beside its name, and a possible axis.
struct Parameter {
  std::string name;
  double value;      // where the experiment names none
  double low, high;  // its range, ends included
  bool whole;        // no fractions
  std::string help;  // what it is, with its unit
};

// What a run measured: columns of results.csv, their units in their names.
using Row = std::vector<std::pair<std::string, double>>;

// What a pattern runs on. Every parameter has a value, and it is in range.
struct Setup {
  const machine::Model& model;
  topologies::Topology topology;  // of one processor where the pattern uses none
  std::map<std::string, double, std::less<>> parameters;
  observe::Watch* watch = nullptr;  // its limit and trace, if there is one

  // Throw machine::InvariantBroken for a parameter that the pattern does not have.
  double operator[](std::string_view name) const;
  std::int64_t whole(std::string_view name) const;
};

struct Pattern {
  std::string name, help;
  bool uses_topology;  // else the experiment may not name a network
  std::vector<Parameter> parameters;
  Row (*run)(const Setup&);  // throws what the simulation throws
};

// A run was cut short: nothing was measured.
struct Unfinished : machine::Fault {
  using Fault::Fault;
};

// Runs a pattern's machine to its end. Throws Unfinished, and what the simulation throws.
void run_machine(const Setup& setup, machine::Machine& machine);

// In the order of a help text.
const std::vector<Pattern>& all_patterns();

}  // namespace patterns

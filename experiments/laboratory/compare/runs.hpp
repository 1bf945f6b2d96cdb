#pragma once
// Results of runs to compare, with the differences between their experiments and machine models.
#include <map>
#include <string>
#include <vector>

#include "experiments/laboratory/compare/matching.hpp"
#include "experiments/laboratory/report/simulation.hpp"

namespace laboratory {

/// A machine model as recorded with the results of a run.
struct RecordedModel {
  struct Entry {
    double value;
    std::string unit;
  };
  std::string name;
  std::map<std::string, Entry> entries;
};

/// A results folder.
struct ComparedRun {
  std::string folder;
  std::string name;     ///< the shortest final part of the folder's path that identifies the run
  std::string command;  ///< the command that produced the results
  std::string version;  ///< version of tlab that produced the results
  Simulation simulation;
  std::vector<RecordedModel> models;
  /// hash of each file that the experiment read, by path
  std::map<std::string, std::string> inputs;
};

/// Loads results folders. Throws BadInput for fewer than two folders, a repeated folder, and a
/// folder with no results or damaged ones.
std::vector<ComparedRun> load_runs(const std::vector<std::string>& folders);

/// Makes the results tables without rows of incomplete points. If an axis of one run is a constant
/// key of another, the other's table also gets this axis, with the constant in every row.
std::vector<NamedTable> make_tables(const std::vector<ComparedRun>& runs);

/// Makes a table with one row for each difference between the experiments: "setting", then a column
/// for each run. Settings are tlab's version, the keys of the experiment files, and the contents of
/// input files. An axis is shown with all its values, "[1, 3, 7]".
Table find_differing_settings(const std::vector<ComparedRun>& runs);

/// Makes a table with one row for each model entry whose values differ: "entry", "unit", then a
/// column for each run. Runs with several models are compared by the models common to all, with
/// entries as "MODEL: ENTRY". An additional row "models" then lists the models of each run.
Table find_differing_entries(const std::vector<ComparedRun>& runs);

}  // namespace laboratory

#pragma once
// Loads the results of runs to compare, and finds differences between their experiments and models.
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

/// The content of a results folder.
struct ComparedRun {
  std::string folder;
  /// the shortest final part of the folder's path that no other compared run has
  std::string name;
  std::string command;  ///< the command that produced the results
  std::string version;  ///< version of tlab that produced the results
  Simulation simulation;
  std::vector<RecordedModel> models;
  /// hash of each file that the experiment read, by the file's path
  std::map<std::string, std::string> inputs;
};

/// Loads results folders. Throws BadInput for fewer than two folders, a repeated folder, and a
/// folder with no results or damaged ones.
std::vector<ComparedRun> load_runs(const std::vector<std::string>& folders);

/// Makes the results table of each run, without rows of incomplete points. If a key is an axis in
/// run A and has a single value in run B, the table of B also gets this axis, with the value in
/// every row.
std::vector<NamedTable> make_tables(const std::vector<ComparedRun>& runs);

/// Makes a table with one row for each setting that differs between the runs: its name, then its
/// value in each run. Settings are tlab's version, the keys of the experiment files, and the
/// contents of input files. An axis is shown as the list of its values, "[1, 3, 7]".
Table find_differing_settings(const std::vector<ComparedRun>& runs);

/// Makes a table with one row for each model entry whose value differs: "entry", "unit", then the
/// value in each run. If a run has several models, only models with names that all runs have are
/// compared. Their entries are shown as "MODEL: ENTRY". If the runs have different models, a row
/// "models" lists the models of each run.
Table find_differing_entries(const std::vector<ComparedRun>& runs);

}  // namespace laboratory

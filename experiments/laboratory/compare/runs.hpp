#pragma once
// Loads the results to compare, and finds differences between their experiments and machines.
#include <map>
#include <string>
#include <vector>

#include "experiments/laboratory/compare/matching.hpp"
#include "experiments/laboratory/report/simulation.hpp"

namespace laboratory {

/// A machine model as recorded with a run.
struct RecordedModel {
  struct Entry {
    double value;
    std::string unit;
  };
  std::string name;
  std::map<std::string, Entry> entries;
};

/// A folder of results.
struct ComparedRun {
  std::string folder;
  std::string name;     ///< the shortest end of the folder's path that differs from all others
  std::string command;  ///< the command that made the results
  std::string version;  ///< of tlab
  Simulation simulation;
  std::vector<RecordedModel> models;
  std::map<std::string, std::string> inputs;  ///< hash of each file that the experiment read
};

/// Throws BadInput for fewer than two folders, a repeated folder, and a folder with no results or
/// damaged ones.
std::vector<ComparedRun> load_runs(const std::vector<std::string>& folders);

/// The tables of the runs, without rows of incomplete points. An axis of one run becomes an axis in
/// all runs that set its key, with one value there.
std::vector<NamedTable> make_tables(const std::vector<ComparedRun>& runs);

/// A table with a row for each difference between the experiments: "setting", then a column for
/// each run. Settings are tlab's version, the keys of the experiment files, and the contents of
/// input files. An axis shows all its values, "[1, 3, 7]".
Table find_differing_settings(const std::vector<ComparedRun>& runs);

/// A table with a row for each model entry whose values differ: "entry", "unit", then a column for
/// each run. For runs with several models it compares the models common to all, as "MODEL: ENTRY",
/// and a row "models" lists those of each run.
Table find_differing_entries(const std::vector<ComparedRun>& runs);

}  // namespace laboratory

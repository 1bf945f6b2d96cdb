#pragma once
// Results that are to be compared, and in what their experiments and machines differ.
#include <map>
#include <string>
#include <vector>

#include "experiments/laboratory/compare/matching.hpp"
#include "experiments/laboratory/report/simulation.hpp"

namespace laboratory {

/// A machine model as a run recorded it.
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
  std::string name;     ///< the last parts of the folder's path, as many as no other run ends with
  std::string command;  ///< that made the results
  std::string version;  ///< of tlab
  Simulation simulation;
  std::vector<RecordedModel> models;
  std::map<std::string, std::string> inputs;  ///< hash of each file that the experiment read
};

/// Throws BadInput for fewer than two folders, for one folder twice, and for a folder that holds no
/// results or damaged ones.
std::vector<ComparedRun> load_runs(const std::vector<std::string>& folders);

/// The tables of the runs, without the rows of points that did not come to their end. What
/// is an axis in one of them is an axis in all: where a run sets that key once, with one value.
std::vector<NamedTable> make_tables(const std::vector<ComparedRun>& runs);

/// A table with a row for each difference between the experiments: "setting", then a column for
/// each run. Settings are tlab's version, the keys of the experiment files, and the contents of
/// input files. An axis shows all its values, "[1, 3, 7]".
Table find_differing_settings(const std::vector<ComparedRun>& runs);

/// A table with a row for each entry of the machine models that has different values: "entry",
/// "unit", then a column for each run. Where a run has several models, entries of the models that
/// all runs have are compared, as "MODEL: ENTRY", and a row "models" names those of each run.
Table find_differing_entries(const std::vector<ComparedRun>& runs);

}  // namespace laboratory

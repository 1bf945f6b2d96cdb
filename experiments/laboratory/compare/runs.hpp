#pragma once
// Results that are to be compared, and what their experiments and machines have not in common.
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/laboratory/compare/ratios.hpp"
#include "experiments/laboratory/report/simulation.hpp"

namespace laboratory {

/// A folder of results.
struct ComparedRun {
  std::string folder;
  std::string name;  ///< the end of its path that no other run has
  std::string command;
  Simulation simulation;
  nlohmann::ordered_json record;  ///< run.json, but for its points
};

/// Throws BadInput for fewer than two folders, one that is there twice, and one that holds no
/// results or damaged ones.
std::vector<ComparedRun> load_runs(const std::vector<std::string>& folders);

std::vector<NamedTable> tables_of(const std::vector<ComparedRun>& runs);

/// A row for each key of the experiment that has another value in some run, and one for the program
/// and for each input file whose content differs: "setting", then a column for each run. Axes have
/// all their values, "[1, 3, 7]"; what a run leaves to the default says so.
Table differing_settings(const std::vector<ComparedRun>& runs);

/// A row for each entry of the machine models that has another value in some run: "entry", "unit",
/// then a column for each run. Where a run has several models, an entry is "MODEL: ENTRY".
Table differing_entries(const std::vector<ComparedRun>& runs);

}  // namespace laboratory

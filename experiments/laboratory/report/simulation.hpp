// Results of all points of an experiment, and their storage in run.json.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/laboratory/judge/check_results.hpp"
#include "experiments/laboratory/points/origin.hpp"
#include "experiments/laboratory/points/point_result.hpp"
#include "experiments/laboratory/setup/host_speed.hpp"
#include "experiments/laboratory/table/table.hpp"

namespace laboratory {

/// Results of a run. Members for "each point" have one element for each element of file.points.
struct Simulation {
  ExperimentFile file;     ///< the experiment; its points are only those that were simulated
  HostSpeeds host_speeds;  ///< measured speeds of the host for cost = "timed"
  /// result of each point; its member `use` is empty, because only the point's record has this data
  Results results;
  /// path of the record of each point, relative to the results folder
  std::vector<std::filesystem::path> records;
  Table table;
  std::vector<CheckResult> checks;
  std::vector<std::string> undrawn;  ///< drawings that failed, with reasons
  std::string ended;                 ///< a sentence that says why the run ended
  bool complete = false;             ///< true if all points were completed
  std::size_t there = 0;             ///< number of points whose results were recorded already
  /// number of points of the run, including the points of randomly drawn machines
  std::size_t asked = 0;
  /// number of randomly drawn machines whose points are not all complete
  std::size_t left_out = 0;
  double wall_s = 0;
};

/// Writes `folder`/run.json. For the run, it has the origin (make_origin), versions, models with
/// the provenance of their entries, hashes of the experiment's files, the reason why the run ended,
/// and the host's speed if it was measured. For each point, it has the result files, seed, loads of
/// processors and links, host times and number of events. Reads the records of the points in
/// `folder` one by one, to save memory.
void save_run_json(const std::filesystem::path& folder, const RunOptions& options,
                   const Simulation& simulation);

/// Reads `folder`/run.json and the records of its points. Makes the table and evaluates the checks
/// again. `file` is the experiment that run.json contains. The members `host_speeds`, `there` and
/// `wall_s` keep their defaults. Throws nlohmann::json::exception for a damaged run.json. Throws
/// base::BadInput if run.json has no points, or if a record is damaged or belongs to another
/// experiment.
Simulation load_simulation(const std::filesystem::path& folder, const ExperimentFile& file);

}  // namespace laboratory

// Results of an experiment's points, and their storage in run.json.
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

/// Results of a run. Members described by "each point" have one element for each of file.points.
struct Simulation {
  ExperimentFile file;     ///< the experiment, with only the points that were run
  HostSpeeds host_speeds;  ///< measured speeds of the host for cost = "timed"
  Results results;         ///< result of each point, without `use`, which only its record has
  /// path of the record of each point, relative to the results
  std::vector<std::filesystem::path> records;
  Table table;
  std::vector<CheckResult> checks;
  std::vector<std::string> undrawn;  ///< failed drawings with reasons
  std::string ended;                 ///< the reason why the run ended, a sentence
  bool complete = false;             ///< true if every point was completed
  std::size_t there = 0;             ///< number of points that already had results
  std::size_t asked = 0;             ///< number of points, also those of randomly drawn machines
  std::size_t left_out = 0;          ///< number of randomly drawn machines with incomplete points
  double wall_s = 0;
};

/// Writes `folder`/run.json. It has the origin (make_origin), versions, models with the provenance
/// of their entries, hashes of the experiment's files, why the run ended, and the host's speed if
/// measured. For each point it has the result files, seed, loads of processors and links, host
/// times and events. Reads the points' records in `folder` one by one.
void save_run_json(const std::filesystem::path& folder, const RunOptions& options,
                   const Simulation& simulation);

/// Reads `folder`/run.json and the records of its points. Makes the table and evaluates the checks
/// anew. `file` is the experiment in run.json. The members `host_speeds`, `there` and `wall_s` keep
/// their defaults. Throws nlohmann::json::exception for a damaged run.json. Throws base::BadInput
/// if run.json has no points, or a record is damaged or from another experiment.
Simulation load_simulation(const std::filesystem::path& folder, const ExperimentFile& file);

}  // namespace laboratory

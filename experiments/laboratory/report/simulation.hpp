// The results of an experiment's points, and their storage in run.json.
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

/// Vectors named "each point" have one element for each of file.points.
struct Simulation {
  ExperimentFile file;     ///< with only the points that were run
  HostSpeeds host_speeds;  ///< for cost = "timed"
  Results results;         ///< result of each point, without "use", which its record has
  std::vector<std::filesystem::path> records;  ///< record of each point, from the results
  Table table;
  std::vector<CheckResult> checks;
  std::vector<std::string> undrawn;  ///< failed drawings with reasons
  std::string ended;                 ///< the reason why the run ended, a sentence
  bool complete = false;             ///< every point was completed
  std::size_t there = 0;             ///< number of points that already had results
  std::size_t asked = 0;             ///< number of points, of all machines
  std::size_t left_out = 0;          ///< drawn machines with incomplete points
  double wall_s = 0;
};

/// Writes `folder`/run.json: the origin (make_origin), versions, models with provenance, hashes of
/// the experiment's files, why the run ended, and the host's speed if measured. For each point it
/// has the result files, seed, loads of processors and links, host times and events. Reads the
/// records of the points, in `folder`, one by one.
void save_run_json(const std::filesystem::path& folder, const RunOptions& options,
                   const Simulation& simulation);

/// Reads `folder`/run.json and the records of its points; makes the table and evaluates the checks
/// anew. `file` is the experiment in run.json. host_speeds, there and wall_s keep their defaults.
/// Throws nlohmann::json::exception for a damaged run.json, base::BadInput for one without points
/// and for a record that is damaged or from another experiment.
Simulation load_simulation(const std::filesystem::path& folder, const ExperimentFile& file);

}  // namespace laboratory

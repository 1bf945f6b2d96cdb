// What came out of running the points of an experiment, and run.json, which keeps it.
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
  ExperimentFile file;     ///< its points are those that were run
  HostSpeeds host_speeds;  ///< where cost = "timed"
  Results results;         ///< result of each point, without "use", which its record has
  std::vector<std::filesystem::path> records;  ///< path of each point's record, from the results
  Table table;
  std::vector<CheckResult> checks;
  std::vector<std::string> undrawn;  ///< drawings that failed, and why
  std::string ended;                 ///< why the run ended, a sentence
  bool complete = false;             ///< every point was run to its end
  std::size_t there = 0;             ///< number of points that had results before
  std::size_t asked = 0;             ///< number of points, of all machines
  std::size_t left_out = 0;          ///< machines drawn that have not all points done
  double wall_s = 0;
};

/// Writes `folder`/run.json: where the results come from (make_origin), versions, models with
/// provenance, hashes of the files that the experiment names, why the run ended, the host's speed
/// where it was measured; for each point its results' files, seed, how busy processors and links
/// were, host times and events. Reads the records of the points, in `folder`, one by one.
void save_run_json(const std::filesystem::path& folder, const RunOptions& options,
                   const Simulation& simulation);

/// Reads `folder`/run.json and the records of its points; makes the table and evaluates the checks
/// anew. `file` is the experiment that run.json holds. host_speeds, there and wall_s stay as they
/// are by default. Throws nlohmann::json::exception for a damaged run.json, base::BadInput for
/// one without points and for a damaged record or one of another experiment.
Simulation load_simulation(const std::filesystem::path& folder, const ExperimentFile& file);

}  // namespace laboratory

#pragma once
// What came out of running every point of an experiment.
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/check_results.hpp"
#include "experiments/host_speed.hpp"
#include "experiments/table.hpp"

namespace experiments {

struct Simulation {
  ExperimentFile file;                          // the points that were run
  HostSpeeds host_speeds;                       // where cost = "timed"
  std::vector<nlohmann::ordered_json> results;  // of each point, see farm_run and pattern_run
  std::vector<std::string> images;              // of each point the file it has saved, or ""
  Table table;
  std::vector<CheckResult> checks;
  std::string ended;      // why, a sentence
  bool complete = false;  // every point was run to its end
  double wall_s = 0;
};

}  // namespace experiments

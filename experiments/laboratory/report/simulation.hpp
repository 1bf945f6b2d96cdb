#pragma once
// What came out of running every point of an experiment.
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/laboratory/judge/check_results.hpp"
#include "experiments/laboratory/points/host_speed.hpp"
#include "experiments/laboratory/points/point_result.hpp"
#include "experiments/laboratory/table/table.hpp"

namespace laboratory {

struct Simulation {
  ExperimentFile file;                         // the points that were run
  HostSpeeds host_speeds;                      // where cost = "timed"
  Results results;                             // of each point
  std::vector<std::filesystem::path> records;  // of each point, in the folder of results: "use" too
  std::vector<std::string> images;             // of each point the file it has saved, or ""
  Table table;
  std::vector<CheckResult> checks;
  std::string ended;      // why, a sentence
  bool complete = false;  // every point was run to its end
  std::size_t there = 0;  // points whose results were there before
  double wall_s = 0;
};

}  // namespace laboratory

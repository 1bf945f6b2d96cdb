#pragma once
// Calibration of cost = "timed": the number of a model's cycles that one second of host CPU time
// represents.
#include <map>
#include <string>
#include <vector>

#include "experiments/laboratory/file/experiment.hpp"

namespace laboratory {

/// Ratio of counted cycles to host time, for the kernels of three workloads: a farm's rays, its
/// blocks of pixels, and shots of radiosity.
struct HostSpeed {
  struct Workload {
    std::string name;
    double cycles_per_host_s = 0;  ///< median of the repeats
    double spread = 0;             ///< of the repeats: (largest - smallest) / median
  };
  double cycles_per_host_s = 0;  ///< geometric mean over the workloads
  double spread = 0;             ///< of the workloads: (largest - smallest) / mean
  int repeats = 0;
  std::vector<Workload> workloads;
  double clock_interval_s = 0;  ///< least time between two readings of the host's clock, s
};
using HostSpeeds = std::map<std::string, HostSpeed>;  ///< Host speeds by model_key.

/// Measures the host for each model that a point with cost = "timed" uses, and sets
/// cycles_per_host_s of all such points.
HostSpeeds measure_host(ExperimentFile& file);

}  // namespace laboratory

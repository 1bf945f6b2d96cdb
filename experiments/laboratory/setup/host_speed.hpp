#pragma once
// Calibration for the setting cost = "timed": how many cycles of the simulated processor one second
// of host CPU time stands for.
#include <map>
#include <string>
#include <vector>

#include "experiments/laboratory/file/experiment.hpp"

namespace laboratory {

/// Ratio of counted cycles to host CPU time. It is measured with three workloads: a farm with
/// single rays as tasks, a farm with blocks of pixels as tasks, and steps of radiosity.
struct HostSpeed {
  struct Workload {
    std::string name;
    double cycles_per_host_s = 0;  ///< median of the repeats
    double spread = 0;             ///< spread of the repeats: (largest - smallest) / median
  };
  double cycles_per_host_s = 0;  ///< geometric mean over the workloads
  double spread = 0;             ///< spread of the workloads: (largest - smallest) / mean
  int repeats = 0;
  std::vector<Workload> workloads;
  double clock_interval_s = 0;  ///< least time between two readings of the host's clock, seconds
};
/// host speeds by model_key() of the machine model
using HostSpeeds = std::map<std::string, HostSpeed>;

/// Measures the host's speed for each machine model that a point with cost = "timed" uses. Sets
/// cycles_per_host_s of all these points.
HostSpeeds measure_host(ExperimentFile& file);

}  // namespace laboratory

#pragma once
// cost = "timed": measures how many cycles of a machine model a second of host CPU time represents.
#include <map>
#include <string>
#include <vector>

#include "experiments/laboratory/file/experiment.hpp"

namespace laboratory {

/// Counted cycles divided by host time, for the kernels of three workloads: a farm's rays, its
/// blocks of pixels, and shots of radiosity.
struct HostSpeed {
  struct Workload {
    std::string name;
    double cycles_per_host_s = 0;  ///< the median of the repeats
    double spread = 0;             ///< of the repeats: (largest - smallest) / median
  };
  double cycles_per_host_s = 0;  ///< the geometric mean of the workloads'
  double spread = 0;             ///< of the workloads: (largest - smallest) / mean
  int repeats = 0;
  std::vector<Workload> workloads;
  double clock_interval_s = 0;  ///< between two readings of the host's clock
};
using HostSpeeds = std::map<std::string, HostSpeed>;  ///< by model_key

/// Measures each model of the points with cost = "timed", and sets their cycles_per_host_s.
HostSpeeds measure_host(ExperimentFile& file);

}  // namespace laboratory

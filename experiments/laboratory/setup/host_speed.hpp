#pragma once
// cost = "timed": how many cycles of a machine model a second of this host's CPU stands for.
#include <map>
#include <string>

#include "experiments/laboratory/file/experiment.hpp"

namespace laboratory {

/// The counted cycles of the kernel over a fixed workload, by the host time they take; repeated.
struct HostSpeed {
  double cycles_per_host_s = 0;  ///< the median
  double spread = 0;             ///< largest less smallest, over the median
  int repeats = 0;
};
using HostSpeeds = std::map<std::string, HostSpeed>;  ///< by model_key

/// Measures each model of the points with cost = "timed", and sets their cycles_per_host_s.
HostSpeeds measure_host(ExperimentFile& file);

}  // namespace laboratory

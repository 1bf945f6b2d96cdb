#pragma once
// Random accesses of all processors to common data (5.1.2.4). Measures the time of each pass and
// where items were found.
#include <optional>

#include "simulator/programs/declare/program.hpp"
#include "simulator/shared_memory/virtual_memory.hpp"

namespace programs {

struct DataLoad {
  network::Params network;
  shared_memory::DataParams data;
  int items = 1000;
  std::uint64_t item_bytes = 64;
  double zipf = 0;                  ///< item k has weight 1 / (k + 1)^zipf; 0 for uniform weights
  int accesses = 1000, passes = 1;  ///< `accesses` is per processor and pass
  /// True: after each pass, all processors wait for the last one. False: each continues
  /// immediately.
  bool together = true;
  bool coordinator_too = false;  ///< the coordinator also makes accesses
  std::uint64_t seed = 1;
};

struct DataPass {
  int number = 0;              ///< number of the pass, from 1
  double time_s = 0;           ///< from the first processor's start to the last one's end
  double mean_s = 0;           ///< mean duration of the pass over the processors
  shared_memory::DataUse use;  ///< total over the processors with accesses
  std::optional<std::uint64_t> server_seen;  ///< requests to the coordinator; only with `together`
};

/// Runs the test. Throws Unfinished and the exceptions of the simulation.
std::vector<DataPass> run_data(const Setup& setup, const network::Routing& routing,
                               const DataLoad& load);

}  // namespace programs

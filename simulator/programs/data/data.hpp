#pragma once
// Random accesses of all processors to common data (thesis, 5.1.2.4). Measures the time of each
// pass over the accesses, and where items were found.
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
  int accesses = 1000, passes = 1;  ///< `accesses`: number for each processor in each pass
  /// If true, each processor waits after each pass until all others have finished it. If false,
  /// each processor continues at once.
  bool together = true;
  bool coordinator_too = false;  ///< if true, the coordinator also makes accesses
  std::uint64_t seed = 1;
};

struct DataPass {
  int number = 0;              ///< number of the pass, from 1
  double time_s = 0;           ///< from the start of the first processor to the end of the last one
  double mean_s = 0;           ///< mean over the processors of the duration of their pass
  shared_memory::DataUse use;  ///< sum over the processors that make accesses
  /// Number of requests that reached the coordinator; only with `together`.
  std::optional<std::uint64_t> server_seen;
};

/// Runs the test. Throws Unfinished if the run is interrupted, and the exceptions of the
/// simulation.
std::vector<DataPass> run_data(const Setup& setup, const network::Routing& routing,
                               const DataLoad& load);

}  // namespace programs

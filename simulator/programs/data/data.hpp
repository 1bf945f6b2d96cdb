#pragma once
// Random accesses to common data from all over a network (5.1.2.4): how long each pass takes, and
// where the items were.
#include <optional>

#include "simulator/declare/program.hpp"
#include "simulator/shared_memory/virtual_memory.hpp"

namespace programs {

struct DataLoad {
  network::Params network;
  shared_memory::DataParams data;
  int items = 1000;
  std::uint64_t item_bytes = 64;
  double zipf = 0;  ///< item k is wanted in proportion to 1 / (k + 1)^zipf; 0: all alike
  int accesses = 1000, passes = 1;  ///< accesses of each processor in each pass
  /// All wait for the last one before the next pass; else each goes on when it is ready.
  bool together = true;
  bool coordinator_too = false;  ///< it makes accesses as the others do
  std::uint64_t seed = 1;
};

struct DataPass {
  int number = 0;     ///< the pass, from 1
  double time_s = 0;  ///< until the last processor has finished it, from the end of the one before
  double mean_s = 0;  ///< time that a processor took for it, on average
  shared_memory::DataUse use;                ///< sum over the processors that made accesses
  std::optional<std::uint64_t> server_seen;  ///< requests that came to the coordinator, if all wait
};

/// Throws Unfinished, and what the simulation throws.
std::vector<DataPass> run_data(const Setup& setup, const network::Routing& routing,
                               const DataLoad& load);

}  // namespace programs

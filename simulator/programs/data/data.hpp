#pragma once
// Random accesses to common data from all processors (5.1.2.4): the time of each pass, and the
// places of the items.
#include <optional>

#include "simulator/programs/declare/program.hpp"
#include "simulator/shared_memory/virtual_memory.hpp"

namespace programs {

struct DataLoad {
  network::Params network;
  shared_memory::DataParams data;
  int items = 1000;
  std::uint64_t item_bytes = 64;
  double zipf = 0;                  ///< item k has weight 1 / (k + 1)^zipf; 0: uniform
  int accesses = 1000, passes = 1;  ///< accesses: per processor and pass
  /// True: all processors wait for the last one after each pass. False: each continues at once.
  bool together = true;
  bool coordinator_too = false;  ///< the coordinator makes accesses like the others
  std::uint64_t seed = 1;
};

struct DataPass {
  int number = 0;              ///< the pass, from 1
  double time_s = 0;           ///< from the first processor's start to the last one's end
  double mean_s = 0;           ///< mean time of a processor
  shared_memory::DataUse use;  ///< sum over the processors with accesses
  std::optional<std::uint64_t> server_seen;  ///< requests received by the coordinator, if all wait
};

/// Throws Unfinished and the simulation's exceptions.
std::vector<DataPass> run_data(const Setup& setup, const network::Routing& routing,
                               const DataLoad& load);

}  // namespace programs

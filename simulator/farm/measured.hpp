#pragma once
// What a run of the farm measures, and the columns that show it.
#include "base/fields.hpp"
#include "simulator/farm/bottleneck.hpp"
#include "simulator/farm/shared_farm.hpp"

namespace farm {

/// How busy processors and links were, as shares of the time, 0 to 1.
struct Busy {
  double worker_mean = 0, worker_max = 0;
  std::optional<double> coordinator, database, display;  ///< where they have processors
  std::string cpu_busiest;
  double cpu_max = 0, cpu_high = 0;  ///< of the busiest CPU; of that, high priority
  std::string link_busiest;          ///< "from>to"
  double link_max = 0;
  std::uint64_t link_messages = 0, link_bytes = 0;  ///< over the busiest direction of a link
  std::uint64_t worker_memory = 0;                  ///< bytes, the most that a worker used
};

struct Measured {
  Measured(SharedResult result, bool has_data, bool is_shared);

  SharedResult run;          ///< only `run.farm` where the workers hold the scene
  bool has_data, is_shared;  ///< a key of [data] is given; workers share the scene's data
  Busy busy;
  std::vector<Load> loads;  ///< of the farm's resources, the busiest first
};

/// The columns of the speed-up are empty, since it needs other runs. Those of [data] are missing
/// where no key of it is given, and empty where nothing is shared.
base::Columns<Measured> make_columns();

}  // namespace farm
